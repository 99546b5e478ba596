#!/bin/sh
# PrusaSlicer's G-code viewer opens FILE; its legend by roles and by widths goes to stdout as text, its window to FOLDER.
# Within xvfb-run with a screen of 1400x900: viewer.sh FILE FOLDER
set -eu
file=$1
folder=$2

# legend PATTERN SIZE: the window's corner as text, once it says PATTERN; the viewer needs a while to read the file.
legend() {
  tries=0
  while [ "$tries" -lt 30 ]; do
    sleep 1
    import -window root -crop "$2+0+48" +repage -resize 300% -colorspace gray -negate "$folder/legend.png"
    tesseract "$folder/legend.png" "$folder/legend" --psm 6 2>/dev/null
    if grep -q "$1" "$folder/legend.txt"; then break; fi
    tries=$((tries + 1))
  done
  cat "$folder/legend.txt"
}

openbox >/dev/null 2>&1 &
manager=$!
prusa-slicer --gcodeviewer "$file" --datadir "$folder/settings" >/dev/null 2>&1 &
viewer=$!
trap 'kill $viewer $manager 2>/dev/null || true' EXIT

legend Total 330x210
import -window root "$folder/roles.png"
xdotool mousemove 120 872 click 1 # the list of views, whose third one is by width
sleep 1
xdotool key Down key Down
legend Width 75x240
import -window root "$folder/widths.png"
