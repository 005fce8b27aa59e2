# Sourced: a Slurm cluster of two nodes on this machine, for the calling user, without munge and
# without root. Needs wait_for of farm_page.sh.
#
#   start_cluster FOLDER   starts slurmctld and the nodes n1 and n2, configured with eight
#                          processors each; state, spools and logs are in FOLDER
#   stop_cluster           stops the cluster after the last job
#   cut_off NODE           disconnects a node: its daemons are killed, its jobs' processes continue
#   processes_on NODE      prints the process ids of its jobs
#
# A job's credential is valid for five seconds, because a requeued job waits until the old one
# expires, by default two minutes.

free_ports() {
  python3 -c 'import socket, sys
sockets = [socket.create_server(("127.0.0.1", 0)) for _ in range(int(sys.argv[1]))]
print(*(s.getsockname()[1] for s in sockets))' "$1"
}

start_cluster() {
  cluster=$1
  local host user controller n1 n2 node
  host=$(hostname -s) user=$(id -un)
  read -r controller n1 n2 < <(free_ports 3)
  mkdir -p "$cluster"/{state,n1,n2}
  cat >"$cluster/slurm.conf" <<EOF
ClusterName=sea
SlurmctldHost=$host(127.0.0.1)
SlurmctldPort=$controller
SlurmUser=$user
SlurmdUser=$user
AuthType=auth/none
CredType=cred/none
AuthInfo=cred_expire=5
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/%n
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/%n/slurmd.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
JobCompType=jobcomp/filetxt
JobCompLoc=$cluster/completions
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=0
SlurmdTimeout=5
KillWait=2
ReturnToService=2
SlurmdParameters=config_overrides
NodeName=n1 NodeHostname=$host NodeAddr=127.0.0.1 Port=$n1 CPUs=8
NodeName=n2 NodeHostname=$host NodeAddr=127.0.0.1 Port=$n2 CPUs=8
PartitionName=farm Nodes=n1,n2 Default=YES State=UP
EOF
  export SLURM_CONF=$cluster/slurm.conf
  PATH=$PATH:/usr/sbin
  slurmctld -D &>"$cluster/slurmctld.out" &
  for node in n1 n2; do slurmd -D -N "$node" &>"$cluster/$node.out" & done
  disown -a  # bash prints nothing when they end
  wait_for 60 nodes_are_idle
}

nodes_are_idle() { [ "$(sinfo --noheader --Node --format=%T 2>/dev/null | sort | uniq -c | xargs)" = '2 idle' ]; }
no_job_is_left() { [ -z "$(squeue --noheader)" ]; }

stop_cluster() {
  wait_for 60 no_job_is_left  # slurmd hangs if a step is still ending
  scontrol shutdown
  wait_for 60 no_daemon_is_left
}

no_daemon_is_left() { ! pgrep -f '^slurm(ctld|d) -D' >/dev/null; }

cut_off() {
  local job
  for job in $(squeue --noheader --nodelist="$1" --format=%A); do
    pkill -KILL -f "^slurmstepd: \\[$job\\."
  done
  pkill -KILL -f "^slurmd -D -N $1\$"
}

processes_on() {
  local folder
  for folder in /proc/[0-9]*; do
    ! grep -qzsx "SLURMD_NODENAME=$1" "$folder/environ" || echo "${folder#/proc/}"
  done
}
