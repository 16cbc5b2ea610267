#!/usr/bin/env bash
# Runs a tiny suite as a job array of a Slurm cluster of this one machine, with daemons and settings of its own, and compares the runs with
# those of a local `ppm compare`. Prints SKIPPED where Debian's slurmctld, slurmd, slurm-client and munge are not installed.
#   tests/slurm/run.sh PPM
set -euo pipefail
ppm=$(realpath "$1")
PATH=$PATH:/usr/sbin
for program in munged slurmctld slurmd sbatch jq; do
  command -v "$program" >/dev/null || { echo "SKIPPED: no $program (slurmctld slurmd slurm-client munge jq)"; exit 0; }
done
dir=$(mktemp -d)
stop() {
  for name in slurmd slurmctld munged; do
    [ -s "$dir/$name.pid" ] || continue
    pid=$(cat "$dir/$name.pid")
    kill "$pid" || true
    for _ in $(seq 100); do  # gone, or waiting for a parent to ask
      case "$(ps -o stat= -p "$pid")" in "" | Z*) break ;; esac
      sleep 0.1
    done
  done
  rm -rf "$dir"
}
trap stop EXIT
fail() {
  echo "FAILED: $*"
  tail -n 20 "$dir"/*.log "$dir"/out/slurm/* 2>/dev/null || true
  exit 1
}
# wait_for SECONDS COMMAND...
wait_for() {
  local left=$(($1 * 5))
  shift
  until "$@" >/dev/null 2>&1; do
    left=$((left - 1))
    [ $left -gt 0 ] || fail "waited too long for: $*"
    sleep 0.2
  done
}

# The cluster: this machine.
host=$(hostname -s)
user=$(id -un)
mkdir -p "$dir/state" "$dir/spool"
chmod 755 "$dir"
dd if=/dev/urandom of="$dir/munge.key" bs=1024 count=1 status=none
chmod 600 "$dir/munge.key"
port=$((20000 + RANDOM % 20000))
cat > "$dir/slurm.conf" <<CONF
ClusterName=ppm
SlurmctldHost=$host(127.0.0.1)
SlurmUser=$user
SlurmdUser=$user
AuthInfo=socket=$dir/munge.socket
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=sched_min_interval=1,batch_sched_delay=0
NodeName=$host NodeAddr=127.0.0.1 CPUs=$(nproc) RealMemory=$(($(awk '/MemTotal/ {print $2}' /proc/meminfo) / 2048))
PartitionName=all Nodes=ALL Default=YES State=UP
CONF
export SLURM_CONF=$dir/slurm.conf
munged --force --key-file="$dir/munge.key" --socket="$dir/munge.socket" --pid-file="$dir/munged.pid" --log-file="$dir/munged.log" \
       --seed-file="$dir/munge.seed"
slurmctld -i || fail "slurmctld"
wait_for 10 test -s "$dir/slurmctld.pid"
slurmd || fail "slurmd"
wait_for 10 test -s "$dir/slurmd.pid"
wait_for 20 sh -c 'sinfo -h -o %t | grep -q idle'

# A suite of two graphs and two seeds.
cat > "$dir/room.yaml" <<'GRAPH'
name: room
nodes:
  - {name: camera, module: source.synthetic_room, params: {frames: 5, pixel_stride: 8, holdout: every 4th}}
  - {name: init, module: map.ppm_empty, in: {frame: camera.frame}, when: {until_frame: 0}, params: {particles: 4}}
  - {name: motion, module: motion.random_walk, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: look, module: prediction.raster, in: {frame: camera.frame}}
  - {name: weigh, module: weighting.robust, in: {frame: camera.frame}, when: {from_frame: 1}}
  - {name: update, module: map_update.ppm_bayes, in: {frame: camera.frame}}
GRAPH
cat > "$dir/suite.yaml" <<'SUITE'
name: tiny
seeds: 2
memory: 100 MB
time_limit: 2 min
slurm: {at_once: 2, options: [--partition=all]}
comparisons:
  - {name: c, graphs: [{name: a, graph: room.yaml}, {name: b, graph: room.yaml, sweep: {init.texel_size: [3 cm]}}]}
SUITE
cd "$dir"
"$ppm" compare suite.yaml --out out --slurm || fail "export"
sbatch --wait out/suite.sbatch || fail "the job array"
"$ppm" compare suite.yaml --out out --report-only || fail "gathering"
[ -s out/report.html ] || fail "no report"
"$ppm" compare suite.yaml --out local || fail "the local suite"

count=0
while read -r job; do
  for file in run.json job.json; do [ -s "out/$job/$file" ] || fail "no $file of $job"; done
  [ "$(jq -r .status "out/$job/job.json")" = done ] || fail "$job is not done"
  [ "$(jq -r .digest "out/$job/run.json")" = "$(jq -r .digest "local/$job/run.json")" ] || fail "$job differs from the local run"
  count=$((count + 1))
done < <(jq -r '.comparisons[].jobs[].folder' local/suite.json)
[ "$count" -eq 4 ] || fail "$count runs"
# What is done is not run again: neither by a task nor by a local compare.
"$ppm" compare suite.yaml --out out --job 3 | grep -q "done before" || fail "a task again"
"$ppm" compare suite.yaml --out out | grep -q "4 done before, 0 done now" || fail "local compare after the array"
echo "4 runs of a job array agree with the local ones"
