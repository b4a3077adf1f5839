"""Two programs beside each other: renders at the same time, each on one thread and a core of its own, their CPU
seconds, and the interval of a median."""
import math
import os
import pathlib
import shutil
import signal
import subprocess


def program(parser, text):
    """The path of a program; an error of the arguments where there is none."""
    found = shutil.which(text)
    if found is None:
        parser.error(f"there is no program '{text}'")
    return str(pathlib.Path(found).resolve())


def cores_of(count, number):
    """Cores for so many renders at the same time, which change places from one number to the next."""
    cores = sorted(os.sched_getaffinity(0))
    if len(cores) < count:
        raise RuntimeError(f"{count} renders at the same time take as many cores, and there is one")
    return cores[:count] if number % 2 == 0 else cores[:count][::-1]


def start(command, core, folder):
    """Starts a command on a core, and a group of processes with it; what it says is kept in a folder."""
    with open(f"{folder}/errors", "w") as errors:
        return subprocess.Popen(["taskset", "-c", str(core), *map(str, command)], stdout=subprocess.DEVNULL, stderr=errors,
                                start_new_session=True)


def finish(process, folder):
    """Waits for a command; its CPU seconds, user and system, with those of all that it started and waited for. Throws
    RuntimeError where it failed."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if status != 0:
        said = pathlib.Path(folder, "errors").read_text(errors="replace").strip()
        raise RuntimeError(f"{process.args[3]}: {said or f'it ended with {process.returncode}'}")
    return usage.ru_utime + usage.ru_stime


def run_together(commands, folders, number):
    """The CPU seconds of commands that run at the same time, each on a core of its own and with a folder for what it
    says. `number` is that of the pair."""
    processes = []
    try:
        for command, core, folder in zip(commands, cores_of(len(commands), number), folders):
            processes.append(start(command, core, folder))
        return [finish(process, folder) for process, folder in zip(processes, folders)]
    finally:
        for process in processes:
            if process.returncode is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


def interval(values):
    """The median of values, the two of them that bound it, and with which chance they do: 95 % or more, by order
    statistics. Of fewer than 6 values it is less."""
    values = sorted(values)
    n = len(values)
    below, chance = 0, 0.5 ** n  # of so many values, or fewer, below the median
    while chance <= 0.025 and below < n // 2:
        below += 1
        chance += math.comb(n, below) * 0.5 ** n
    # `below` values at each end may be left out, less the one that went too far.
    k = max(below - 1, 0)
    middle = 0.5 * (values[(n - 1) // 2] + values[n // 2])
    beyond = sum(math.comb(n, i) for i in range(k + 1)) * 0.5 ** n  # on one side
    return middle, values[k], values[n - 1 - k], max(1 - 2 * beyond, 0)
