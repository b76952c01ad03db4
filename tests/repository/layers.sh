#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT
# A module includes only the promises it may: what CMake's include paths enforce, said once more by name.
set -euo pipefail
cd "$1"
status=0
forbid() { # FOLDER PATTERN: no file of the folder includes a header that matches
    if grep -rnE "#include <($2)" "$1"; then
        echo "$1 must not include these"
        status=1
    fi
}
forbid support 'study/|renderer/|stimuli/|measure/|experiment/|stats/'
forbid study 'renderer/|stimuli/|measure/|experiment/|stats/'
forbid renderer 'study/|stimuli/|measure/|experiment/|stats/'
forbid renderer/optics 'renderer/(scene|gl|passes|reference)/'
forbid renderer/scene 'renderer/(gl|passes|reference)/'
forbid renderer/gl 'renderer/(optics|scene|passes|reference)/'
forbid renderer/passes 'renderer/reference/'
forbid renderer/reference 'renderer/(gl|passes)/|epoxy/'
forbid stimuli 'measure/|experiment/|stats/'
forbid measure 'experiment/|stats/'
forbid experiment 'renderer/(optics|scene|passes|reference)/|stimuli/|measure/|stats/'
forbid stats 'study/|renderer/|stimuli/|measure/|experiment/|epoxy/|GLFW/|OpenImageIO/'
exit $status
