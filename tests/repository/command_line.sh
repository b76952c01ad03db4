#!/usr/bin/env bash
# SPDX-FileCopyrightText: 2026 The skin2afc authors
# SPDX-License-Identifier: MIT
# The program's promises on the command line: bad input gives one line on stderr and exit code 2, and leaves nothing.
set -uo pipefail
skin2afc=$1
source=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
status=0

complain() {
    echo "FAILED: $*"
    status=1
}

# refuses WORDS ARGUMENT...: exit code 2, one line that holds the words, and no file more than before.
refuses() {
    local words=$1 before after
    shift
    before=$(find . | sort)
    "$skin2afc" "$@" >stdout.txt 2>stderr.txt </dev/null
    local code=$?
    local message lines
    message=$(cat stderr.txt)
    lines=$(wc -l <stderr.txt)
    rm -f stdout.txt stderr.txt
    after=$(find . | sort)
    [ $code -eq 2 ] || complain "$*: expected exit code 2, found $code"
    [ "$lines" -eq 1 ] || complain "$*: expected one line, found $lines: $message"
    [[ $message == *"$words"* ]] || complain "$*: expected \"$words\", found: $message"
    [ "$before" = "$after" ] || complain "$*: left files behind: $(diff <(echo "$before") <(echo "$after"))"
}

# A protocol of small pictures, quick to render.
sed -e 's/^width = .*/width = 132/' -e 's/^height = .*/height = 79/' -e 's/^map_size = 1024$/map_size = 64/' \
    "$source/protocols/jimenez2009.toml" >small.toml

# Usage.
refuses "subcommand" # no command at all
refuses "PROTOCOL" stimuli
refuses "--nonsense" stimuli small.toml --out out --nonsense

# Stimuli: missing file, wrong field, unknown shader, truncated model, unwritable folder.
refuses "missing.toml: no such file" stimuli missing.toml --out out
refuses "missing.glb: no such file" stimuli small.toml --out out --model missing.glb
sed 's/^fov_deg/fov_degrees/' small.toml >field.toml
refuses "camera.fov_degrees: unknown field" stimuli field.toml --out out
sed 's/^width = 132/width = "wide"/' small.toml >type.toml
refuses 'image.width: expected a whole number' stimuli type.toml --out out
sed 's/^exposure.*//; s/^height = 79/height = nan/' small.toml >nan.toml
refuses 'image.height: expected a whole number' stimuli nan.toml --out out
sed 's/"ss_full"\]/"wax"]/' small.toml >shader.toml
refuses 'shaders: expected a shader' stimuli shader.toml --out out
echo 'name = [' >broken.toml
refuses 'broken.toml:1' stimuli broken.toml --out out
refuses 'found "wax"' stimuli small.toml --out out --only shader=wax
refuses '--shard: expected I/N' stimuli small.toml --out out --shard 3/2
printf 'glTF\2\0\0\0\377\377\0\0\20\0\0\0JSON{"asset"' >truncated.glb
refuses "truncated.glb: expected a glTF 2.0 model" stimuli small.toml --out out --model truncated.glb
sed 's/^samples = 4/samples = 64/' small.toml >samples.toml
refuses 'samples: expected at most' stimuli samples.toml --out out
sed 's/^samples = 4/samples = 3/' small.toml >samples.toml
refuses 'image.samples: expected a power of two' stimuli samples.toml --out out
touch file
refuses "file: expected a folder" stimuli small.toml --out file
refuses "/proc/out: expected a folder" stimuli small.toml --out /proc/out

# Head: names of skin, ages, places.
refuses "--out is required" head
refuses '--skin: expected I, II' head --out head.glb --skin pale
refuses '--skin: expected I, II' head --out head.glb --skin 0.7
refuses '--age: expected 18 to 90' head --out head.glb --age 7
refuses '--seed' head --out head.glb --seed -1
refuses '--level: expected full, fifth or tenth' head --out head.glb --level low
refuses '--out: expected a file that ends in .glb' head --out head.obj
refuses 'expected a folder, found none' head --out none/head.glb

# Session: half a set of stimuli, labels, observers.
"$skin2afc" stimuli small.toml --out half --only azimuth=0,60 >/dev/null 2>&1 || complain "half a set cannot be rendered"
refuses "manifest.json" session small.toml --stimuli half/none --study study --participant 01 --simulate null
refuses "half" session small.toml --stimuli half --study study --participant 01 --simulate null
"$skin2afc" stimuli small.toml --out set >/dev/null 2>&1 || complain "the set cannot be rendered"
refuses "../01" session small.toml --stimuli set --study study --participant ../01 --simulate null
refuses "a/b" session small.toml --stimuli set --study study --participant a/b --simulate null
refuses "nobody" session small.toml --stimuli set --study study --participant 01 --simulate nobody
refuses "/proc/study" session small.toml --stimuli set --study /proc/study --participant 01 --simulate null
mkdir -p deep other
{ printf '{"images": [{"shader": '; head -c 400000 /dev/zero | tr '\0' '['; } >deep/manifest.json
refuses "nested" session small.toml --stimuli deep --study study --participant 01 --simulate null
refuses "nested" stimuli small.toml --out deep
printf 'name\n' >other/participants.tsv
refuses 'participants.tsv:1: expected "participant_id"' session small.toml --stimuli set --study other \
    --participant 01 --simulate null

# Analysis: no study, an empty one, no place for the result.
refuses "STUDY is required" analyse --out analysis
refuses "no/study" analyse no/study --out analysis
refuses "not in range" analyse --power --proportion 2
mkdir empty
refuses "empty" analyse empty --out analysis
"$skin2afc" session small.toml --stimuli set --study study --participant 01 --simulate null >/dev/null 2>&1 ||
    complain "a session cannot be simulated"
refuses "/proc/analysis" analyse study --out /proc/analysis

# What is right is done, and help reads like a manual page.
"$skin2afc" analyse study --out analysis >/dev/null 2>&1 || complain "the study cannot be analysed"
[ -s analysis/table2.tsv ] && [ -s analysis/report.html ] || complain "the analysis wrote no table or no report"
for command in "" stimuli head compare "bench accuracy" session analyse; do
    # shellcheck disable=SC2086 # the empty command is no argument
    "$skin2afc" $command --help | grep -q "EXIT STATUS" || complain "$command --help has no section EXIT STATUS"
done
exit $status
