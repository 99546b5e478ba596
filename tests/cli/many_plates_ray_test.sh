#!/usr/bin/env bash
# examples/many-plates/cluster.py on two local nodes of Ray, one of which is killed: every plate is there once, with the bytes
# of a local run. Needs Ray for the Python that PYTHON names (python3).
#   tests/cli/many_plates_ray_test.sh SILLON
set -euo pipefail
export SILLON=$1 SOURCE_DATE_EPOCH=0 PICTURE=64 RAY_USAGE_STATS_ENABLED=0
export RAY_raylet_start_wait_time_s=600 # a busy machine takes longer than the default of 30
example=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples/many-plates" && pwd)
python=${PYTHON:-python3}
"$python" -c 'import ray' 2>/dev/null || { echo "skipped: Ray is not installed for $python" && exit 0; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

fail() {
  echo "many_plates_ray_test: $*" >&2
  exit 1
}

mkdir -p projects/shapes
echo '<svg xmlns="http://www.w3.org/2000/svg" width="12mm" height="9mm"><path d="M0 0h45v34h-45z"/></svg>' >projects/shapes/plate.svg
for k in 10 11 12 13 14 15 16 17 18 19 20 21; do
  echo "{ \"sillon\": 1, \"shape\": { \"builtin\": \"disc\", \"size\": [$k, 0] }, \"directions\": { \"angle\": $k } }" >"projects/disc $k.json"
done
echo '{ "sillon": 1, "shape": { "file": "shapes/plate.svg" } }' >projects/drawn.json
echo '{ "sillon": 1, "shape": { "builtin": "disc", "size": [-1, 0] } }' >projects/wrong.json

# Stands before the program: its first plate kills the node. Files are listed by who hands out the work.
cat >program <<'TEXT'
#!/usr/bin/env bash
if [[ $* != *--list-files* ]] && mkdir "$KILLED" 2>/dev/null; then
  kill -KILL "$PPID" "$(ps -o ppid= -p "$PPID" | tr -d ' ')"
  sleep 60
fi
exec "$PROGRAM" "$@"
TEXT
chmod +x program
cat >run.py <<'TEXT'
import runpy, sys
import ray
from ray.cluster_utils import Cluster

cluster = Cluster(initialize_head=True, head_node_args={"num_cpus": 0})
cluster.add_node(num_cpus=1)
cluster.add_node(num_cpus=1)
ray.init(address=cluster.address, log_to_driver=False)
# As a program, whose functions travel to the nodes; those of a module would be looked for there.
code = runpy.run_path(sys.argv[1] + "/cluster.py")["main"]("projects", "plates")
ray.shutdown()
cluster.shutdown()
sys.exit(code)
TEXT
export PROGRAM=$SILLON KILLED=$folder/killed
code=0
SILLON=$folder/program "$python" run.py "$example" >said 2>&1 || code=$?
[ "$code" = 2 ] || fail "exit code $code instead of 2 with a project at fault: $(cat said)"
[ -d killed ] || fail "no node was killed"
grep -q '^wrong: .*size.*-1' said || fail "the project at fault is not told with its reason: $(cat said)"
grep -q '13 plates made, 1 failed' said || fail "it said $(cat said)"
[ "$(find plates -name '*.gcode' | wc -l)" = 13 ] || fail "not every plate is there: $(ls plates)"
[ "$(find plates -name '*.part' | wc -l)" = 0 ] || fail "parts of files were left: $(ls plates)"

(cd projects && "$SILLON" generate "disc 12.json" --quiet --gcode ../disc.gcode && "$SILLON" generate drawn.json --quiet --gcode ../drawn.gcode)
cmp disc.gcode "plates/disc 12.gcode" || fail "a node gave other bytes"
cmp drawn.gcode plates/drawn.gcode || fail "a node gave other bytes of a drawing"

# Run again, only what failed is tried.
rm "plates/disc 10.gcode"
sed -i 's/-1/12/' projects/wrong.json
"$python" "$example/cluster.py" projects plates >said 2>&1 || fail "the second run failed: $(cat said)"
[ -s plates/wrong.gcode ] || fail "what was mended was not made"
[ ! -e plates/wrong.err ] || fail "an old error is still there"
[ ! -e "plates/disc 10.gcode" ] || fail "a plate that was done was made again"
echo "many plates with Ray: a node lost, every plate once, the same bytes"
