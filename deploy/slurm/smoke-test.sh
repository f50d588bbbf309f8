#!/usr/bin/env bash
# A farm under Slurm on one machine that plays four nodes: deploy/slurm/smoke-test.sh antipode antipode-server
#
# Renders alone, then on four servers of which one is drained and one killed; sums must be equal. Then a job whose server loses
# its device for good must be requeued. Needs root, slurmctld, slurmd, slurm-client, munge, jq and curl; it stops what it starts.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
export ANTIPODE ANTIPODE_SERVER
ANTIPODE=$(realpath "${1:?"Usage: smoke-test.sh ANTIPODE ANTIPODE-SERVER"}") ANTIPODE_SERVER=$(realpath "${2:?}")
scene=$here/../../scenes/pool.textproto
options=(--width 96 --height 64 --iterations "${ITERATIONS:-200}" --quiet --no-error)

place=$(mktemp -d)
host=$(hostname -s)
pids=()
finish() {
    local code=$?
    ((code == 0)) || tail -n 20 "$place"/slurmctld.log "$place"/*.out >&2 || true
    scancel --quiet --user=root 2> /dev/null || true
    sleep 1
    kill "${pids[@]}" 2> /dev/null || true
    wait
    rm -rf "$place"
}
trap finish EXIT
say() { echo "$(date +%T) $*"; }
fail() {
    say "FAILED: $*"
    exit 1
}
# until_true SECONDS WHAT COMMAND…
until_true() {
    local limit=$((SECONDS + $1)) what=$2
    shift 2
    until "$@" > /dev/null 2>&1; do
        ((SECONDS < limit)) || fail "$what"
        sleep 0.3
    done
}

# --- the pretended cluster --------------------------------------------------------------------------------------------
mkdir -p "$place"/{munge,state,spool,bin}
head -c 128 /dev/urandom > "$place/munge/key"
chmod 600 "$place/munge/key"
chmod 755 "$place" "$place/munge"
{
    cat << CONF
ClusterName=smoke
SlurmctldHost=$host(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthInfo=socket=$place/munge/socket
ProctrackType=proctrack/pgid
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
StateSaveLocation=$place/state
SlurmdSpoolDir=$place/spool/%n
SlurmctldPort=17000
SlurmctldPidFile=$place/slurmctld.pid
SlurmdPidFile=$place/slurmd-%n.pid
SlurmdParameters=config_overrides
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
GresTypes=gpu
SchedulerParameters=bf_interval=1,sched_interval=2,batch_sched_delay=0
JobRequeue=1
RequeueExit=75
ReturnToService=2
SlurmdTimeout=8
KillWait=4
NodeName=rn[1-4] NodeHostname=$host NodeAddr=127.0.7.[1-4] Port=[17001-17004] CPUs=4 Boards=1 SocketsPerBoard=1 CoresPerSocket=4 ThreadsPerCore=1 RealMemory=1000 Gres=gpu:1 State=UNKNOWN
PartitionName=render Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
} > "$place/slurm.conf"
for node in 1 2 3 4; do echo "NodeName=rn$node Name=gpu File=/dev/null"; done > "$place/gres.conf"
export SLURM_CONF=$place/slurm.conf
munged --force --foreground --key-file "$place/munge/key" --socket "$place/munge/socket" --pid-file "$place/munge/pid" \
    --log-file "$place/munge.log" --seed-file "$place/munge/seed" 2> "$place/munged.log" &
pids+=($!)
until_true 10 "munged does not answer" test -S "$place/munge/socket"
slurmctld -D > "$place/slurmctld.log" 2>&1 &
pids+=($!)
for node in 1 2 3 4; do
    slurmd -D -N "rn$node" > "$place/slurmd-$node.log" 2>&1 &
    pids+=($!)
done
until_true 30 "not all nodes are idle" bash -c '[[ $(sinfo --noheader --Node --states=idle | wc -l) == 4 ]]'
say "four nodes are idle: $(sinfo --version)"

# This machine's device as if nvidia-smi told of it: the batch script must find it by its UUID.
uuid=$("$ANTIPODE" devices --json | jq -r '.[0].uuid')
cat > "$place/bin/nvidia-smi" << FAKE
#!/bin/sh
[ "\$3" = --id=0 ] && echo "GPU-$(sed 's/^\(.\{8\}\)\(.\{4\}\)\(.\{4\}\)\(.\{4\}\)/\1-\2-\3-\4-/' <<< "$uuid")"
FAKE
chmod +x "$place/bin/nvidia-smi"
export PATH=$place/bin:$PATH
(umask 077 && head -c 32 /dev/urandom | base64 > "$place/secret")
export ANTIPODE_SERVER_PSK_FILE=$place/secret ANTIPODE_RENDER_PSK_FILE=$place/secret
export TMPDIR=$place ANTIPODE_DISCOVERY_SECONDS=1

# --- one image --------------------------------------------------------------------------------------------------------
cd "$place"
start=$SECONDS
env -u ANTIPODE_RENDER_PSK_FILE "$ANTIPODE" render "$scene" "${options[@]}" -o alone.exr --stats alone.json
say "alone: $(jq -r .sums_sha256 alone.json) after $((SECONDS - start)) s"

job=$(sbatch --parsable --array=0-3 --output="$place/server-%a.out" "$here/antipode-servers.sbatch")
until_true 60 "not all servers listen" bash -c "[[ \$(grep -l 'listening on' $place/server-?.out | wc -l) == 4 ]]"
grep -q "attempt 1 on rn., GPU-" server-0.out || fail "the batch script did not find its GPU"
say "four servers listen: $(grep -ho 'listening on [0-9.:]*' server-?.out | sort | tr '\n' ';')"

start=$SECONDS
"$here/render-on" "$job" "$scene" "${options[@]}" -o farm.exr --stats farm.json --metrics 127.0.0.1:17100 &
client=$!
pids+=("$client")
committed() {
    local count
    count=$(curl --silent --max-time 2 http://127.0.0.1:17100/metrics | sed -n 's/^antipode_committed_iterations //p')
    (($(printf '%.0f' "$count") >= $1))
}
until_true 60 "the farm renders nothing" committed 20
scancel --signal=TERM --batch "${job}_1"
say "task 1 is told to drain"
until_true 40 "task 1 does not drain" grep -q "antipode-server ended with 0" server-1.out
say "task 1 has drained"
kill -9 "$(pgrep -f "$ANTIPODE_SERVER\$" | while read -r pid; do
    grep -qz '^SLURM_ARRAY_TASK_ID=2$' "/proc/$pid/environ" && echo "$pid"
done)"
say "the server of task 2 is killed"
until_true 30 "task 2 does not start again" grep -q "attempt 2" server-2.out
code=0
wait "$client" || code=$?
((code == 0)) || fail "the client ended with $code"
say "farm: $(jq -r .sums_sha256 farm.json) after $((SECONDS - start)) s, by $(jq -r '[.nodes[] | "\(.name) \(.iterations)"] | join(", ")' farm.json)"
[[ $(jq .sums_sha256 alone.json) == "$(jq .sums_sha256 farm.json)" ]] || fail "the farm's image is another one"
(($(jq '[.nodes[] | select(.iterations > 0)] | length' farm.json) >= 3)) || fail "fewer than three servers rendered"

# --- every server drains ----------------------------------------------------------------------------------------------
scancel --signal=TERM --batch "$job"
until_true 40 "servers do not drain" bash -c "[[ -z \$(squeue --noheader --jobs=$job 2> /dev/null) ]]"
(($(grep -l "ended with 0" server-?.out | wc -l) == 4)) || fail "a server did not drain"
say "all servers have drained"

# --- a device that is lost for good -------------------------------------------------------------------------------------
printf '#!/bin/sh\nexit 75\n' > bin/lost-server
chmod +x bin/lost-server
job=$(ANTIPODE_SERVER=$place/bin/lost-server sbatch --parsable --array=0 --output="$place/lost.out" "$here/antipode-servers.sbatch")
requeued() { scontrol show job "${job}_0" | grep -q 'Restarts=1'; }
until_true 60 "a lost device does not requeue the job" requeued
(($(grep -c "ended with 75" lost.out) == 3)) || fail "the server was not tried three times first"
say "three ends with 75 requeued the job: $(scontrol show job "${job}_0" | grep -o 'Restarts=1')"
scancel "$job"
say "passed"
