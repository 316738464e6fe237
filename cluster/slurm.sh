#!/usr/bin/env bash
# A benchmark or training data as a Slurm array with a dependent merge: the same bytes as one run.
#
#   cluster/slurm.sh SHARDS OUT PROGRAM COMMAND...
#
#   cluster/slurm.sh 16 runs/tasks pushplan bench tasks tasks/*.yaml
#   cluster/slurm.sh 64 data/train pushplan-learn generate --preset tools --episodes 60000 --seed 1
#   cluster/slurm.sh 16 runs/crowds pushplan-lab evaluate --on sparse dense
#
# Every element measures its shard into a folder of its own below OUT.shards, and when all are done
# the last job merges them into OUT. Run the same command again, from the same folder, after
# something went wrong and nothing runs any more: it submits only the shards that are missing. A
# requeued element goes on where it was, as every finished task is on the disk.
#
# What the cluster wants to know is said as for any sbatch, in the environment or here:
#   SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT, SBATCH_MEM_PER_CPU, ...
#   CPUS        processors of an element, by default 4; programs use as many threads
#
# Exit codes: `pushplan solve`, `run` and `verify` tell answers by theirs. 4 (no plan), 5 (fails in
# simulation) and 7 (works too seldom) are answers, but to Slurm they are failures, for which
# `--dependency=afterok` waits in vain. An array of such commands says which are fine:
#
#   pushplan solve "$task" --out plans || case $? in 4 | 5 | 7 | 8) ;; *) exit 1 ;; esac
#
# The commands of this script exit with 0 if and only if the shard is whole. 130 means that a signal
# ended it in between; what was finished is kept.
set -euo pipefail

# What a job does is its first word, and not in the environment, which some clusters do not hand on.
step=submit
case ${1:-} in --shard | --merge) step=${1#--} && shift ;; esac

if [ $# -lt 4 ]; then
  sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "$0"
  exit 2
fi
shards=$1 out=$2 program=$3
shift 3

# Where the command takes the folder: data are named, everything else is put `--out`; and what the
# program calls what is done with its runs. (Lists that may be empty are no error to an old bash so.)
place=(--out) kept=()
case $(basename "$program") in
pushplan) kept=(bench) ;;
pushplan-learn) [ "$1" != generate ] || place=() ;;
pushplan-lab) ;;
*)
  echo "$program is none of pushplan, pushplan-learn and pushplan-lab" >&2
  exit 2
  ;;
esac

case $step in
shard)
  number=$SLURM_ARRAY_TASK_ID
  # Instead of this shell, so that signals reach it.
  exec "$program" "$@" ${place[@]+"${place[@]}"} "$out.shards/$number" --shard "$number/$shards"
  ;;
merge)
  exec "$program" ${kept[@]+"${kept[@]}"} merge "$out" "$out".shards/[0-9]*
  ;;
esac

if [ -e "$out/manifest.json" ]; then
  echo "$out holds a run already" >&2
  exit 2
fi
mkdir -p "$out.shards/log"
missing=1-$shards
# `log` is no shard; what was begun is.
if compgen -G "$out.shards/[0-9]*" >/dev/null; then
  missing=$("$program" ${kept[@]+"${kept[@]}"} status "$out".shards/[0-9]*)
fi
after=()
if [ -n "$missing" ]; then
  job=$(sbatch --parsable --job-name=pushplan --array="$missing" --cpus-per-task="${CPUS:-4}" \
    --requeue --open-mode=append --output="$out.shards/log/%a.txt" \
    "$0" --shard "$shards" "$out" "$program" "$@")
  job=${job%%;*}
  echo "array $job: shards $missing"
  after=(--dependency="afterok:$job" --kill-on-invalid-dep=yes)
fi
job=$(sbatch --parsable --job-name=pushplan-merge ${after[@]+"${after[@]}"} \
  --output="$out.shards/log/merge.txt" "$0" --merge "$shards" "$out" "$program" "$@")
echo "job ${job%%;*}: merge into $out"
