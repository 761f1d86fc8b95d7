#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Copyright 2026 The odosplat authors
# fingerprint.sh ODOSPLAT OUT SEQ...: SHA-256 of what the program computes on the demo's room and on a short run of each
# sequence (cloud, map of 300 steps, 100 frames tracked in it). To check that a change does not alter results, run this
# before and after it: the two lists must be the same. Times are left out, as they differ between runs.
set -euo pipefail
program=$1 out=$2
shift 2
mkdir -p "$out"
[ -z "$(ls -A "$out")" ] || { echo "$out is not empty" >&2 && exit 2; }
"$program" demo --out "$out/demo" --log warning >/dev/null
for sequence; do
  made=$out/$(basename "$sequence")
  "$program" cloud "$sequence" --every 10 --voxel 0.03 --noise 0.006 --out "$made.cloud.ply" --log warning >/dev/null
  "$program" train "$sequence" --every 10 --cloud "$made.cloud.ply" --iterations 300 --out "$made.map.ply" \
    --log warning >/dev/null
  "$program" track "$sequence" --frames 0:100 --map "$made.map.ply" --start truth --out "$made.track" \
    --log warning >/dev/null
done
cd "$out"
find . -name status.csv | while read -r file; do
  awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i ~ /ms$|milliseconds/) drop[i] = 1 }
    { for (i in drop) $i = "" } 1' "$file" >"$file.untimed"
done
find . \( -name '*.ply' -o -name 'trajectory*.txt' -o -name '*.untimed' -o -name covariance.csv \
  -o -name '*.png' \) \
  ! -path './demo/sequence/*' -print0 | LC_ALL=C sort -z | xargs -0 sha256sum
