#!/usr/bin/env bash
# examples/many-plates on two hosts reached by SSH, one of them lost in the middle of its work.
#   tests/cli/many_hosts_test.sh SILLON
# The hosts are network namespaces of this machine. They, their processes and all files belong to namespaces that end with
# this test, however it ends: nothing is left, and nothing of the machine is changed. Needs root, and the tools below.
set -euo pipefail
examples=$(cd "$(dirname "${BASH_SOURCE[0]}")/../../examples" && pwd)
PATH=$PATH:/usr/sbin:/sbin

if [ "${2:-}" != inside ]; then
  for tool in parallel jq ip ssh sshd unshare; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed" && exit 0; }
  done
  unshare --net --mount --pid --fork true 2>/dev/null || { echo "skipped: no namespaces without root" && exit 0; }
  ! grep -q '^root:!' /etc/shadow || { echo "skipped: root is locked, and sshd lets nobody in" && exit 0; }
  exec unshare --net --mount --pid --fork --kill-child --mount-proc "${BASH_SOURCE[0]}" "$1" inside
fi

mount -t tmpfs -o mode=755 tmpfs /run # sshd trusts no key in a folder that others may write
mkdir /run/sshd /run/netns /run/centre
cp "$1" /run/sillon
cd /run/centre
export SILLON=/run/sillon SOURCE_DATE_EPOCH=0 HOME=$PWD PICTURE=64

fail() {
  echo "many_hosts_test: $*" >&2
  exit 1
}
# until_true WHAT COMMAND...: waits for a state, as long as the run goes on.
until_true() {
  while ! "${@:2}"; do
    kill -0 "$run" 2>/dev/null || fail "the run ended before $1: $(cat said)"
    sleep 0.1
  done
}

# --- Projects: discs, shapes in files of their own, names with a space and a quote, one that names another -----------

mkdir -p projects/shapes
project() {
  printf '{ "sillon": 1, "shape": %s, "toolpath": { "spacing": 1 }, "printer": { "name": "drawing1.json" } }' "$2" >"projects/$1.json"
}
for k in $(seq 10 47); do project "disc's $k" "{ \"builtin\": \"disc\", \"size\": [$k, 0] }"; done
for k in 1 2; do
  project "drawing$k" "{ \"file\": \"shapes/drawing $k.svg\" }"
  echo "<svg xmlns='http://www.w3.org/2000/svg' width='20mm' height='${k}0mm' viewBox='0 0 20 10'><path d='M1 1H19V9H1Z'/></svg>" \
    >"projects/shapes/drawing $k.svg"
done
JOBS=2 "$examples/many-plates/run" projects expected >/dev/null || fail "the local run failed"

# --- Hosts: each with its own address, sshd and temporary folder; the projects and plates are not on their disk -------

ssh-keygen -q -t ed25519 -N '' -f key
host() { # host NAME NUMBER
  mkdir -p "/run/$1/tmp" "/run/$1/bin"
  ssh-keygen -q -t ed25519 -N '' -f "/run/$1/key"
  echo "10.0.$2.2 $(cut -d' ' -f1,2 "/run/$1/key.pub")" >>known_hosts
  cp key.pub "/run/$1/authorized"
  cat >"/run/$1/config" <<TEXT
ListenAddress 10.0.$2.2:22
HostKey /run/$1/key
AuthorizedKeysFile /run/$1/authorized
PidFile none
UsePAM no
PermitRootLogin yes
SetEnv TMPDIR=/run/$1/tmp PATH=/run/$1/bin:/usr/local/bin:/usr/bin:/bin
TEXT
  ip netns add "$1"
  ip link add "to-$1" type veth peer name eth0 netns "$1"
  ip addr add "10.0.$2.1/24" dev "to-$1"
  ip link set "to-$1" up
  ip -n "$1" addr add "10.0.$2.2/24" dev eth0
  ip -n "$1" link set eth0 up
  (ip netns exec "$1" sh -c 'mount -t tmpfs tmpfs /run/centre && exec "$@"' sh "$(command -v sshd)" -D -f "/run/$1/config" \
    -E "/run/$1/log" &)
}
: >known_hosts
host north 1
host south 2
cat >config <<TEXT
User root
IdentityFile $PWD/key
IdentitiesOnly yes
UserKnownHostsFile $PWD/known_hosts
BatchMode yes
ConnectTimeout 5
ServerAliveInterval 3
ServerAliveCountMax 3
TEXT
export SSH="ssh -F $PWD/config" HOST_SILLON=sillon HOSTS="2/10.0.1.2 2/10.0.2.2"

# North makes three plates; of every other one it sends the first bytes of the archive, and no more. South makes twelve and
# then waits until north is lost. So the state in which north is lost is the same on a fast machine and a slow one.
real_tar=$(command -v tar)
ln -s /run/sillon /run/north/bin/sillon
cat >/run/north/bin/tar <<TEXT
#!/bin/sh
case "\$*" in *-xf*) exec $real_tar "\$@" ;; esac
echo >>/run/north/sent
[ "\$(wc -l </run/north/sent)" -gt 3 ] || exec $real_tar "\$@"
$real_tar "\$@" | head -c 5000
echo >>/run/north/stuck
exec sleep infinity
TEXT
cat >/run/south/bin/sillon <<TEXT
#!/bin/sh
case "\$1" in generate) echo >>/run/south/made ;; esac
[ ! -e /run/south/made ] || [ "\$(wc -l </run/south/made)" -le 12 ] || until [ -e /run/lost ]; do sleep 0.1; done
exec /run/sillon "\$@"
TEXT
chmod +x /run/north/bin/tar /run/south/bin/sillon

for number in 1 2; do
  for try in $(seq 100); do
    if $SSH "10.0.$number.2" true 2>/dev/null; then break; fi
    [ "$try" != 100 ] || fail "no sshd answers: $(cat /run/*/log)"
    sleep 0.1
  done
done

# --- The run ---------------------------------------------------------------------------------------------------------

mkdir -p plates/.incoming/old
echo half >plates/.incoming/old/archive # as a machine leaves it that goes down while it runs this
"$examples/many-plates/run" projects plates >said 2>&1 &
run=$!
plates() { find plates -maxdepth 1 -name '*.json' | wc -l; }
ten_plates_and_one_at_work() { [ "$(plates)" -ge 10 ] && [ -e /run/north/stuck ]; }
until_true "ten plates were there and north was at work" ten_plates_and_one_at_work
half_sent() { [ -n "$(find plates/.incoming -name archive -size +0)" ]; }
until_true "an archive was half sent" half_sent

# As when its power fails: no connection is closed, it just falls silent.
ip -n north link set eth0 down
ip netns pids north | xargs kill -KILL
touch /run/lost
wait "$run" || fail "the run failed: $(cat said) $(cat plates/*.err)"

grep -q '40 plates made, 0 missing' said || fail "said $(cat said)"
diff -r -x jobs.log -x 'd*.json' plates expected >&2 || # reports have times; the table has what else they say
  fail "the plates are not those of a run on one machine, each once and nothing beside"
[ "$(find plates -type f | wc -l)" = 123 ] || fail "not 40 plates of three files, a table, a list and a log: $(find plates)"
[ "$(awk 'NR > 1 && $7 == 0 { print $9, $10 }' plates/jobs.log | wc -l)" = 40 ] || fail "the log does not have each plate once"
for number in 1 2; do
  grep -qF "10.0.$number.2" plates/jobs.log || fail "host $number made nothing: $(cat plates/jobs.log)"
done
[ -z "$(ls /run/south/tmp)" ] || fail "south still has $(find /run/south/tmp)"

# Run again with one plate more and a project at fault: north is left out, and only what is new is made.
cp plates/jobs.log before
project last '{ "builtin": "disc", "size": [9, 0] }'
project fault '{ "builtin": "disc", "size": [-1, 0] }'
code=0
"$examples/many-plates/run" projects plates >said 2>&1 || code=$?
[ "$code" = 2 ] || fail "a project at fault gave $code: $(cat said)"
grep -q '10.0.1.2 is left out' said || fail "the lost host is not named: $(cat said)"
grep -q '41 plates made, 1 missing' said || fail "the second run said $(cat said)"
grep -q '^"fault","no".*size.*-1' plates/report.csv || fail "the table does not say what is wrong: $(cat plates/fault.err)"
[ "$(($(wc -l <plates/jobs.log) - $(wc -l <before)))" = 2 ] || fail "not just the new plates were made"
[ ! -e plates/.incoming ] || fail "half a plate is left"

# A host with another program ends the run.
printf '#!/bin/sh\necho sillon 0.0.1\n' >/run/south/bin/sillon
code=0
"$examples/many-plates/run" projects plates >said 2>&1 || code=$?
grep -q '10.0.2.2 has sillon 0.0.1' said || fail "another program was taken: $code $(cat said)"
[ "$code" = 2 ] || fail "another program ended the run with $code"
echo "many hosts: one lost, every plate there once"
