#!/usr/bin/env bash
# tools/quietly.sh COMMAND...: runs a command, and shows what it printed only when it fails.
set -euo pipefail

log=$(mktemp)
trap 'rm -f "$log"' EXIT
status=0
"$@" >"$log" 2>&1 </dev/null || status=$?
if ((status != 0)); then
    cat "$log" >&2
    echo "failed with status $status: $*" >&2
fi
exit "$status"
