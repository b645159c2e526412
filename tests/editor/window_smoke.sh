#!/usr/bin/env bash
# usage: window_smoke.sh LUTKA SCREENSHOT: opens the editor in a real window on a virtual screen, drags the doll with a
# real pointer, and closes it from the keyboard. Prints "skipped: …" where the tools for it are missing.
set -euo pipefail
lutka=$1
screenshot=$2
for tool in Xvfb xdotool; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not there"; exit 0; }
done

folder=$(mktemp -d)
pids=()
cleanup() {
  for pid in "${pids[@]}"; do kill "$pid" 2>/dev/null || true; done
  rm -rf "$folder"
}
trap cleanup EXIT

Xvfb -displayfd 3 -screen 0 1280x720x24 3>"$folder/display" 2>"$folder/xvfb.log" &
pids+=($!)
for _ in $(seq 100); do [ -s "$folder/display" ] && break; sleep 0.1; done
[ -s "$folder/display" ] || { echo "skipped: Xvfb does not start"; exit 0; }
DISPLAY=:$(cat "$folder/display")
export DISPLAY
export XDG_CONFIG_HOME=$folder/config

"$lutka" edit --record-input "$folder/input.jsonl" >"$folder/editor.log" 2>&1 &
editor=$!
pids+=("$editor")
window=$(timeout 60 xdotool search --sync --onlyvisible --name Lutka | head -1)
[ -n "$window" ] || { echo "no window was opened"; cat "$folder/editor.log"; exit 1; }
sleep 2
xdotool mousemove 640 560 mousedown 1
for step in 1 2 3 4 5 6; do
  xdotool mousemove $((640 + step * 5)) $((560 - step * 40))
  sleep 0.3
done
xdotool mouseup 1
xdotool key F3
sleep 1
xdotool key ctrl+q
for _ in $(seq 150); do kill -0 "$editor" 2>/dev/null || break; sleep 0.2; done
kill -0 "$editor" 2>/dev/null && { echo "Ctrl+Q did not close the window"; exit 1; }
status=0
wait "$editor" || status=$?
[ "$status" -eq 0 ] || { echo "the editor ended with $status"; cat "$folder/editor.log"; exit 1; }
for event in '"event":"mouseMove"' '"button":"left","pressed":true' '"button":"left","pressed":false' '"key":"F3"'; do
  grep -q -- "$event" "$folder/input.jsonl" || { echo "the window never sent $event"; exit 1; }
done

# What was recorded plays again without the window.
"$lutka" edit --headless --input "$folder/input.jsonl" \
  --screenshot-at "$(tail -1 "$folder/input.jsonl" | sed 's/.*"frame":\([0-9]*\).*/\1/'):$screenshot"
[ -s "$screenshot" ] || { echo "the replay made no picture"; exit 1; }
echo "done"
