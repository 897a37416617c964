"""A Slurm of one node for a test: munged, slurmctld and slurmd with a configuration, a key and ports of
their own. It takes root, as slurmd does."""

import os
import pathlib
import pwd
import shutil
import socket
import subprocess
import time

PATIENCE = 60.0  # s
CONFIGURATION = """\
ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmUser=root
SlurmctldPort={controller_port}
SlurmdPort={node_port}
AuthType=auth/munge
AuthInfo=socket={home}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/spool
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/slurmd.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MaxArraySize={array_size}
KillWait=5
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def why_not():
    """Why there is no cluster here, or None."""
    if "RIESEL_SLURM" not in os.environ:
        return "RIESEL_SLURM=1 tests sweeps on Slurm, for some minutes"
    if os.geteuid() != 0:
        return "Slurm is tested by root only"
    missing = [name for name in ("munged", "slurmctld", "slurmd", "sbatch")
               if shutil.which(name) is None]
    return f"{', '.join(missing)} not found: ./setup.sh cluster" if missing else None


def free_port():
    with socket.socket() as any_port:
        any_port.bind(("127.0.0.1", 0))
        return any_port.getsockname()[1]


class Cluster:
    """`environment` is for whoever calls sbatch and the like."""

    def __init__(self, home, array_size):
        self.home = pathlib.Path(home)
        self.daemons = []
        for name in ("state", "spool", "munge"):
            (self.home / name).mkdir()
        configuration = self.home / "slurm.conf"
        configuration.write_text(CONFIGURATION.format(
            home=self.home, host=socket.gethostname().partition(".")[0], array_size=array_size,
            controller_port=free_port(), node_port=free_port()), encoding="utf-8")
        (self.home / "cgroup.conf").write_text("CgroupPlugin=cgroup/v1\n", encoding="utf-8")
        self.environment = {**os.environ, "SLURM_CONF": str(configuration)}

    def start(self):
        munge = self.home / "munge"
        (munge / "key").write_bytes(os.urandom(128))
        user = pwd.getpwnam("munge")
        for path in (munge, munge / "key"):
            os.chown(path, user.pw_uid, user.pw_gid)
        munge.chmod(0o755)
        (munge / "key").chmod(0o400)
        self.home.chmod(0o755)
        self._start("munged", "--foreground", f"--socket={munge}/socket", f"--key-file={munge}/key",
                    f"--pid-file={munge}/pid", f"--log-file={munge}/log",
                    f"--seed-file={munge}/seed", user=user.pw_uid, group=user.pw_gid)
        self.wait_until((munge / "socket").exists, "munged")
        self._start("slurmctld", "-D", "-c")
        self._start("slurmd", "-D", "-N", socket.gethostname().partition(".")[0])
        self.wait_until(lambda: "idle" in self.ask("sinfo", "--noheader", "--format=%T"), "slurmd")

    def stop(self):
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(timeout=10.0)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def ask(self, *command):
        """What a program of Slurm answers; nothing while it cannot."""
        return subprocess.run(command, env=self.environment, capture_output=True, text=True,
                              check=False).stdout

    def jobs(self):
        """[(array task, state, how often it was queued again)] of those that are not over; None if
        nobody knows at the moment."""
        said = subprocess.run(["squeue", "--noheader", "--array",
                               "--Format=ArrayTaskID,State,RestartCnt"], env=self.environment,
                              capture_output=True, text=True, check=False)
        if said.returncode != 0:
            return None
        return [tuple(line.split()) for line in said.stdout.splitlines()]

    def wait_for_all_jobs(self, patience=PATIENCE):
        """A job on its way to be queued again is in no list for a moment: it takes several looks."""
        looks = 10
        empty = [False] * looks

        def all_empty():
            empty.append(self.jobs() == [])
            return all(empty[-looks:])

        self.wait_until(all_empty, "the end of all jobs", patience)

    def wait_until(self, happened, what, patience=PATIENCE, more_logs=str):
        """With the logs and the jobs if it never happens: they tell why. `more_logs` returns more text for it."""
        deadline = time.monotonic() + patience
        while not happened():
            if time.monotonic() > deadline:
                raise AssertionError(f"{what}: not within {patience} s\n{self.logs()}\n{self.jobs()}\n{more_logs()}")
            time.sleep(0.1)

    def logs(self):
        return "\n".join(path.read_text(errors="replace")[-3000:]
                         for path in self.home.glob("*.log"))

    def _start(self, *command, **user):
        with open(self.home / f"{command[0]}.out", "wb") as log:
            self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log,
                                                 stderr=log, stdin=subprocess.DEVNULL, **user))
