# SPDX-License-Identifier: BSD-3-Clause
"""Servers for tests, on ports of the system's choice."""
import contextlib
import os
import re
import signal
import subprocess


def mpi_environment():
    """The environment for mpiexec.

    pvpython, which runs this, is an MPI process by itself, and what that leaves in the environment would
    make mpiexec fail. Containers have few cores, and often only root; processes that wait shall not spin
    meanwhile.
    """
    own = {name: value for name, value in os.environ.items()
           if not name.startswith(("OMPI_", "PMIX_", "ORTE_", "PMI_"))}
    return dict(own,
                OMPI_ALLOW_RUN_AS_ROOT="1",
                OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                OMPI_MCA_rmaps_base_oversubscribe="1",
                OMPI_MCA_mpi_yield_when_idle="1")


@contextlib.contextmanager
def running(command, kind="server"):
    """Starts a pvserver, maybe under mpiexec; gives its port, and stops it in the end.

    kind: "data-server" or "render-server" for pvdataserver and pvrenderserver.
    """
    server = subprocess.Popen([*command, f"--{kind}-port=0"], stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, env=mpi_environment(),
                              start_new_session=True)
    try:
        for line in server.stdout:
            accepting = re.search(r"Accepting connection\(s\): .*:(\d+)", line)
            if accepting:
                yield int(accepting.group(1))
                return
        raise SystemExit(f"{command[-1]} did not start")
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.killpg(server.pid, signal.SIGKILL)
        server.wait()
