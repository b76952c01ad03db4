#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT
# Each [Key2009] that the sources cite has its entry in REFERENCES.bib, and each entry is cited.
set -euo pipefail
cd "$1"
cited=$(grep -rohE '\[[A-Z][A-Za-z]+[0-9]{4}' --include='*.h' --include='*.cpp' --include='*.glsl' --include='*.frag' \
    --include='*.vert' support study renderer stimuli measure experiment stats tests | tr -d '[' | sort -u)
entries=$(grep -oE '^@[a-z]+\{[A-Za-z0-9]+' REFERENCES.bib | sed 's/.*{//' | sort -u)
[ -n "$cited" ]
diff <(echo "$cited") <(echo "$entries")
