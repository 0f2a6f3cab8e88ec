# SPDX-License-Identifier: MIT
"""The machine, the folder and the port, as doctor sees them."""

import os
import socket

import pytest
from tricue.doctor import machine
from tricue.doctor.finding import Verdict


def test_the_machine_is_described():
    """Cores and memory are those that the system has."""
    found = {each.name: each.text for each in machine.find_machine()}
    assert found["cores"].startswith(str(os.cpu_count()))
    assert found["memory"].split()[1].startswith("GB")
    assert float(found["memory"].split()[0]) > 0
    assert all(found.values())


def test_a_container_has_limits(tmp_path, monkeypatch):
    """They are told beside what the machine has."""
    monkeypatch.setattr(machine, "_GROUPS", tmp_path)
    (tmp_path / "cpu.max").write_text("150000 100000\n")
    (tmp_path / "memory.max").write_text("2000000000\n")
    found = {each.name: each.text for each in machine.find_machine()}
    assert "the container has the time of 1.5" in found["cores"]
    assert found["memory"].endswith("the container may use 2.0 GB")


def test_a_folder_that_can_be_written(tmp_path, monkeypatch):
    """It is left as it was."""
    monkeypatch.chdir(tmp_path)
    found = machine.find_places()[0]
    assert "can be written" in found.text
    assert not list(tmp_path.iterdir())


def test_a_folder_that_can_not_be_written(tmp_path, monkeypatch):
    """It is a warning, with the system's reason."""

    def refuse(**_: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(machine.tempfile, "TemporaryFile", refuse)
    found = machine.find_places()[0]
    assert found.verdict is Verdict.WARNING
    assert "can't be written: Read-only file system" in found.text


def test_a_folder_that_was_removed(tmp_path, monkeypatch):
    """The other findings are told all the same."""
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    found = machine.find_places()[0]
    assert (found.verdict, found.text) == (Verdict.WARNING, "was removed")


def test_a_port_that_is_taken(monkeypatch):
    """tricue open then takes another one, so that nothing is wrong."""
    with socket.create_server((machine.ADDRESS, 0)) as taken:
        monkeypatch.setattr(machine, "PORT", taken.getsockname()[1])
        found = machine.find_places()[1]
    assert found.verdict is Verdict.OK
    assert "is in use; it takes another" in found.text
    assert "is free" in machine.find_places()[1].text


def test_the_port_is_that_of_tricue_open():
    """It is written down twice, as doctor imports nothing else."""
    local_server = pytest.importorskip("tricue.app.local_server", reason="needs tricue[app]")
    assert (machine.ADDRESS, machine.PORT) == (local_server.ADDRESS, local_server.DEFAULT_PORT)
