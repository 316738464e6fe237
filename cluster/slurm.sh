#!/usr/bin/env bash
# A benchmark or training data as a Slurm array with a dependent merge: the same bytes as one run.
#
#   cluster/slurm.sh SHARDS OUT PROGRAM COMMAND...
#
#   cluster/slurm.sh 16 runs/tasks pushplan bench tasks tasks/*.yaml
#   cluster/slurm.sh 64 data/train pushplan-learn generate --preset tools --episodes 60000 --seed 1
#   cluster/slurm.sh 16 runs/crowds pushplan-lab evaluate --on sparse dense
#
# Every array element measures its shard into a separate folder below OUT.shards. After all elements
# have finished, the last job merges the shards into OUT. If an element failed, wait until no job runs
# any more, and rerun the same command from the same folder: it submits only the missing shards. A
# requeued element resumes its shard, because every finished task is saved.
#
# Options of the cluster are set as for any sbatch, in the environment or here:
#   SBATCH_PARTITION, SBATCH_ACCOUNT, SBATCH_TIMELIMIT, SBATCH_MEM_PER_CPU, ...
#   CPUS        processors of an element, by default 4; programs use as many threads
#
# Exit codes: `pushplan solve`, `run` and `verify` report results by their exit codes. Slurm treats 4
# (no plan), 5 (fails in simulation), 7 (fragile) and 8 (partial) as failures, so
# `--dependency=afterok` would wait forever. An array of such commands must accept them:
#
#   pushplan solve "$task" --out plans || case $? in 4 | 5 | 7 | 8) ;; *) exit 1 ;; esac
#
# The commands of this script exit with 0 if and only if the shard is complete. 130 means that a signal
# interrupted the command; finished tasks are kept.
set -euo pipefail

# The first argument selects the step, because some clusters do not pass the environment on to jobs.
step=submit
case ${1:-} in --shard | --merge) step=${1#--} && shift ;; esac

if [ $# -lt 4 ]; then
  sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "$0"
  exit 2
fi
shards=$1 out=$2 program=$3
shift 3

# The option that names the folder (none for data), and the subcommand that contains `merge` and
# `status`. (Empty lists are expanded in a way that is no error in an old bash.)
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
  # Replaces this shell, so that signals reach the program.
  exec "$program" "$@" ${place[@]+"${place[@]}"} "$out.shards/$number" --shard "$number/$shards"
  ;;
merge)
  exec "$program" ${kept[@]+"${kept[@]}"} merge "$out" "$out".shards/[0-9]*
  ;;
esac

if [ -e "$out/manifest.json" ]; then
  echo "$out already holds a run" >&2
  exit 2
fi
mkdir -p "$out.shards/log"
missing=1-$shards
# `log` is not a shard; every started shard has a folder.
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
