# SPDX-License-Identifier: MIT
"""Tasks on a Dask cluster of this machine, and in several processes, through losses and errors."""

import os
import signal
import time
import warnings
from pathlib import Path

import pytest
from tricue.evaluation import schedule, tables
from tricue.evaluation.dataset import Entry
from tricue.evaluation.evaluate import Options, evaluate
from tricue.evaluation.record import Record
from tricue.evaluation.tasks import Task, perform
from tricue.evaluation.tracker_spec import TrackerSpec

FEW = Options(("color-particle", "still-box"), seeds=4)


class Victim:
    """Performs tasks, slowly; the worker that performs the given one dies of it, so many times."""

    def __init__(self, marks: Path, deadly: str, deaths: int = 1) -> None:
        self.marks, self.deadly, self.deaths = marks, deadly, deaths

    def __call__(self, task: Task) -> Record:
        time.sleep(0.05)
        if task.name == self.deadly:
            with (self.marks / "deaths").open("a") as file:
                file.write("x")
            if (self.marks / "deaths").stat().st_size <= self.deaths:
                os.kill(os.getpid(), signal.SIGKILL)
        return perform(task)


@pytest.fixture(scope="module")
def cluster():
    """A scheduler with two worker processes."""
    distributed = pytest.importorskip("distributed", reason="needs the extra dask")
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None
    ) as found:
        yield found.scheduler_address


def table(folder, evaluation):
    """The bytes of the tables that tell what the runs say."""
    tables.write(evaluation, folder, {})
    return [(folder / name).read_bytes() for name in (tables.ROWS, tables.SUMMARY)]


def test_a_cluster_says_what_one_process_says_though_a_worker_dies(cluster, folders, tmp_path):
    """The tasks of a worker that was killed in the middle run on another; the tables are the same bytes."""
    alone = table(tmp_path, evaluate(folders, tmp_path / "alone", FEW))
    victim = Victim(tmp_path, "one-pass/color-particle/there/seed-2")
    evaluation = evaluate(folders, tmp_path / "many", FEW, scheduler=cluster, work=victim)
    assert (tmp_path / "deaths").read_text() == "xx"
    assert table(tmp_path, evaluation) == alone
    assert not evaluation.failed


def test_a_cluster_runs_trackers_that_are_not_ours(cluster, folders, tmp_path):
    """One that crashes its process doesn't end the worker: the others of its kind and of ours have rows."""
    odd = Path(__file__).parent / "foreign" / "odd_trackers.py"
    options = Options(("still-box", f"{odd}:Crashes", f"{odd}:Still"), restarts=False)
    evaluation = evaluate(folders, tmp_path, options, scheduler=cluster)
    assert len(evaluation.results) == 3 * 3
    assert not evaluation.failed
    troubles = {each.row.tracker for each in evaluation.results if each.row.trouble}
    assert troubles == {"odd_trackers.py:Crashes"}


def test_errors_of_a_sequence_come_back_from_the_cluster(cluster, tmp_path):
    """A task whose sequence isn't there is told; the others have their records."""
    (tmp_path / "empty").mkdir()
    tasks = [Task(TrackerSpec("still-box"), Entry(name, tmp_path / name)) for name in ("gone", "empty")]
    found = {each.task_index: each for each in schedule.run_tasks(tasks, perform, scheduler=cluster)}
    assert all(each.record is None for each in found.values())
    assert "gone: there is no such file or folder" in found[0].error
    assert "empty" in found[1].error


def test_processes_give_what_is_finished_as_it_comes(tmp_path):
    """Each task comes back with its index; errors don't stop the others."""
    tasks = [
        Task(TrackerSpec("still-box"), Entry(str(number), tmp_path / str(number))) for number in range(5)
    ]
    for jobs in (1, 2):
        found = list(schedule.run_tasks(tasks, perform, jobs))
        assert sorted(each.task_index for each in found) == list(range(5))
        assert all("no such file or folder" in each.error for each in found)


def test_warnings_of_other_processes_are_given_here_once(tmp_path, capfd):
    """Printed there, each of them would repeat a warning, with lines of source code."""

    def warn(task: Task) -> Record:
        warnings.warn("no depth in all sequences", UserWarning, stacklevel=1)
        warnings.warn(f"no depth in {task.entry.name}", UserWarning, stacklevel=1)
        raise ValueError("done")

    tasks = [Task(TrackerSpec("still-box"), Entry(str(each), tmp_path)) for each in range(4)]
    with pytest.warns(UserWarning, match="no depth in") as caught:
        assert len(list(schedule.run_tasks(tasks, warn, jobs=2))) == 4
    expected = ["no depth in all sequences", *(f"no depth in {each}" for each in range(4))]
    assert sorted(str(each.message) for each in caught) == sorted(expected)
    assert "no depth" not in "".join(capfd.readouterr())


def test_there_are_no_more_processes_than_tasks(tmp_path):
    """Each process costs a second and memory: of eight only two start for two tasks."""
    from joblib.externals.loky.process_executor import ProcessPoolExecutor

    started = []
    adjust = ProcessPoolExecutor._adjust_process_count

    def count(pool: ProcessPoolExecutor) -> None:
        adjust(pool)
        started.append(len(pool._processes))

    tasks = [Task(TrackerSpec("still-box"), Entry(str(each), tmp_path / str(each))) for each in range(2)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(ProcessPoolExecutor, "_adjust_process_count", count)
        assert len(list(schedule.run_tasks(tasks, perform, jobs=8))) == 2
    assert max(started) == 2


@pytest.mark.parametrize(("deaths", "failed"), [(1, []), (9, ["one-pass/color-particle/there/seed-2"])])
def test_a_killed_process_costs_only_the_run_that_kills_it(folders, tmp_path, deaths, failed):
    """Runs go on without the process; a run that kills another one, too, is reported."""
    victim = Victim(tmp_path, "one-pass/color-particle/there/seed-2", deaths)
    evaluation = evaluate(folders, tmp_path / "many", FEW, jobs=2, work=victim)
    assert (tmp_path / "deaths").read_text() == "xx"
    assert list(evaluation.failed) == failed
    assert all("its process was killed" in error for error in evaluation.failed.values())
    alone = evaluate(folders, tmp_path / "alone", FEW)
    assert len(evaluation.results) == len(alone.results) - len(failed)


def test_a_terminals_interrupt_is_for_the_process_that_asks(tmp_path):
    """Ctrl-C goes to every process of a terminal; those that run tasks never see it."""

    def interrupt(_: Task) -> Record:
        os.kill(os.getpid(), signal.SIGINT)
        blocked = signal.pthread_sigmask(signal.SIG_BLOCK, [])
        raise ValueError(f"{sorted(blocked)}")

    tasks = [Task(TrackerSpec("still-box"), Entry(str(each), tmp_path)) for each in range(3)]
    for found in schedule.run_tasks(tasks, interrupt, jobs=2):
        assert found.error == f"{[signal.SIGINT]}"
    assert not signal.pthread_sigmask(signal.SIG_BLOCK, [])


def test_what_is_closed_is_ended_at_once(tmp_path, monkeypatch):
    """Tasks that still run don't run on, also where joblib's own thread is slow to hear of it."""
    from joblib.externals.loky.process_executor import _ExecutorManagerThread as Manager

    def stay(task: Task) -> Record:
        if task.entry.name != "first":
            (tmp_path / str(os.getpid())).touch()
            time.sleep(60)
        raise ValueError(task.entry.name)

    end = Manager.flag_executor_shutting_down
    monkeypatch.setattr(Manager, "flag_executor_shutting_down", lambda self: (time.sleep(0.5), end(self)))
    tasks = [Task(TrackerSpec("still-box"), Entry(name, tmp_path)) for name in ("first", "second", "third")]
    running = schedule.run_tasks(tasks, stay, jobs=2)
    assert next(running).error == "first"
    while not (started := list(tmp_path.iterdir())):
        time.sleep(0.01)
    running.close()
    deadline = time.monotonic() + 20
    while any(Path("/proc", each.name).exists() for each in started) and time.monotonic() < deadline:
        time.sleep(0.01)
    assert not any(Path("/proc", each.name).exists() for each in started)


def test_ctrl_c_right_after_a_task_was_given_prints_nothing(tmp_path, monkeypatch):
    """Also where joblib's own thread hears of the task and of its end at once: it raised a KeyError."""
    from joblib.externals.loky.process_executor import _ExecutorManagerThread as Manager

    def stay(task: Task) -> Record:
        time.sleep(0 if task.entry.name == "0" else 60)
        raise ValueError

    def wake(self: Manager) -> object:
        found = woken(self)
        time.sleep(0.3)
        return found

    def wait(*running: object, **until: object) -> object:
        return next(waits)(*running, **until)

    waits = iter([schedule.wait])
    woken = Manager.wait_result_broken_or_wakeup
    monkeypatch.setattr(Manager, "wait_result_broken_or_wakeup", wake)
    monkeypatch.setattr(schedule, "wait", wait)
    tasks = [Task(TrackerSpec("still-box"), Entry(str(each), tmp_path)) for each in range(3)]
    running = schedule.run_tasks(tasks, stay, jobs=2)
    next(running)
    with pytest.raises(RuntimeError):  # of the second wait, as Ctrl-C would raise there
        next(running)


def test_no_scheduler_is_told_by_its_address(monkeypatch):
    """Nothing listens there: OSError, not a hang."""
    pytest.importorskip("distributed", reason="needs the extra dask")
    monkeypatch.setattr(schedule, "CONNECT_TIMEOUT", "1s")
    with pytest.raises(OSError, match=r"127\.0\.0\.1:9"):
        list(
            schedule.run_tasks(
                [Task(TrackerSpec("still-box"), Entry("a", Path("a")))], perform, 1, "tcp://127.0.0.1:9"
            )
        )


@pytest.mark.parametrize("address", ["host", "tcp://host", "tcp://host:port", "tcp://", "http://host:8786"])
def test_an_impossible_address_is_refused_at_once(address, monkeypatch):
    """It proves that no client is made for it, which would hang for 20 s and print a traceback."""
    distributed = pytest.importorskip("distributed", reason="needs the extra dask")
    monkeypatch.setattr(distributed, "Client", None)
    tasks = [Task(TrackerSpec("still-box"), Entry("a", Path("a")))]
    with pytest.raises(ValueError, match=rf"^scheduler: expected an address .*, got '{address}'"):
        list(schedule.run_tasks(tasks, perform, scheduler=address))
