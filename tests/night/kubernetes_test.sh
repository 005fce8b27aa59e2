#!/usr/bin/env bash
# Tests contrib/kubernetes: its Jobs match the types that the Kubernetes project generates from its
# API, and the commands of their containers, for every index, give the files of one run. There is no
# cluster.
#
# usage: kubernetes_test.sh PELAGIC FOLDER    FOLDER keeps the types between runs
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
mkdir -p "$2"
types=$(realpath "$2")
. "$here/farm_page.sh"
open_page "$1"
for package in kubernetes-types@1.30.0 typescript@5.4.5; do
  [ -d "$types/node_modules/${package%@*}" ] || npm install --no-audit --no-fund --prefix "$types" "$package"
done

echo '== The fields are those of batch/v1 Job'
fields_are_known() {
  { echo 'import type { Job } from "kubernetes-types/batch/v1"; export const job: Job ='; cat; } >"$types/job.ts"
  (cd "$types" && npx tsc --noEmit --strict job.ts)
}
for file in contrib/kubernetes/*.yaml; do python3 "$here/kubernetes_job.py" json "$file" | fields_are_known; done
if python3 "$here/kubernetes_job.py" json contrib/kubernetes/pelagic-merge.yaml | sed s/restartPolicy/restart/ | fields_are_known; then
  fail 'the types let an unknown field pass'
fi

echo '== What the containers run, with /sea here'
mkdir sea
cp shot.toml sea
for job in export merge; do
  sed "$small" contrib/kubernetes/pelagic-$job.yaml >$job.yaml
  python3 "$here/kubernetes_job.py" run $job.yaml "$work/sea"
done
mv sea/waves .
same_as_one_run
