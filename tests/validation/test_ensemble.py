# SPDX-License-Identifier: GPL-2.0-or-later
"""validation/ensemble.py on the real hosts: what is finished is kept, and nothing else is taken for finished."""

import json
import os
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "packing"))
import packing  # noqa: E402
from packing import ensemble  # noqa: E402

SEED = packing.primes(1)[0]


def short(host="liggghts", style="stock", nt=6, **variables):
    return packing.settling(host, style, nt, SEED, **{"n": 20, "duration": 0.006, **variables})


def started(capfd):
    """How many runs were started since the last call, from the progress."""
    lines = [line for line in capfd.readouterr().out.splitlines() if line.startswith("test: ") and " of " in line]
    return int(lines[-1].split()[-1]) if lines else 0


@pytest.mark.parametrize("host", ensemble.HOSTS)
@pytest.mark.parametrize("style", ["stock", "cfpm"])
def test_a_finished_run_is_kept(tmp_path, capfd, host, style):
    runs = [short(host, style, nt=1.5), short(host, style)]
    first = ensemble.run(runs, tmp_path, "test")
    assert started(capfd) == 2
    assert ensemble.run(runs, tmp_path, "test") == first
    assert started(capfd) == 0
    for result, steps in zip(first, (45, 180)):
        assert steps - 1 <= result.steps <= steps  # LIGGGHTS's deck does one of them when it puts the spheres in
        assert not result.blown_up and result.cpu_seconds > 0 and result.nanoseconds > 0
        assert sorted(file.name for file in result.folder.iterdir()) == ["packing.csv", "run.json"]
        assert packing.read(result).ratio[-1] > 0


def test_equal_runs_are_done_once(tmp_path, capfd):
    one, other = ensemble.run([short(), short()], tmp_path, "test")
    assert one == other and started(capfd) == 1


def test_what_decides_the_outcome_decides_the_name(tmp_path, monkeypatch):
    deck = tmp_path / "in.packing"
    deck.write_text("deck")
    bed, same_bed = tmp_path / "bed", tmp_path / "same"
    bed.write_text("bed")
    same_bed.write_text("bed")
    plugin = tmp_path / "plugin.so"
    plugin.write_text("plugin")
    monkeypatch.setattr(ensemble.HOSTS["liggghts"], "PLUGIN", plugin)
    cfpm, stock = ({"style": style, "nt": 6, "bed": bed} for style in ("cfpm", "stock"))
    run = ensemble.Run("liggghts", deck, cfpm)
    conventional = replace(run, variables=stock)
    names = {run.name(), conventional.name(), replace(run, variables={**cfpm, "nt": 3}).name()}
    assert len(names) == 3
    assert replace(run, variables={**cfpm, "bed": same_bed}).name() == run.name()
    assert replace(run, cost=9).name() == run.name()

    before, conventional_before = run.name(), conventional.name()
    plugin.write_text("plugin, built anew")
    assert run.name() != before and conventional.name() == conventional_before
    plugin.write_text("plugin")
    for file in (deck, bed):
        text = file.read_text()
        file.write_text("changed")
        assert run.name() != before and conventional.name() != conventional_before
        file.write_text(text)
    assert run.name() == before


def test_files_of_the_deck_are_kept_on_request(tmp_path):
    run = replace(short(restart=1), keep=("*.csv", "*.restart"))
    (result,) = ensemble.run([run], tmp_path, "test")
    assert (result.folder / "packing.restart").stat().st_size > 0


def test_blow_up_is_an_outcome(tmp_path):
    (result,) = ensemble.run([packing.settling("liggghts", "stock", 1, SEED)], tmp_path, "test")
    assert result.blown_up and result.steps is None and packing.read(result).blown_up


def test_run_that_no_particle_is_left_of_has_no_cost_per_particle():
    assert ensemble.longest_loop("Loop time of 2.5 on 1 procs for 10 steps with 0 atoms\n") == (10, 2.5, None)


def test_interrupted_run_is_started_anew(tmp_path, capfd):
    """One short run and one of minutes, interrupted when the first is done."""
    script = f"""import sys
sys.path[:0] = {sys.path!r}
import test_ensemble as t
t.ensemble.run([t.short(), t.short(duration=500)], {str(tmp_path)!r}, "test", cores=1)
"""
    environment = {**os.environ, "PYTHONPATH": str(Path(__file__).parent)}
    process = subprocess.Popen([sys.executable, "-c", script], env=environment, stdout=subprocess.PIPE, text=True)
    deadline = time.monotonic() + 60
    while len(list(tmp_path.glob("*"))) < 3 and time.monotonic() < deadline:  # lock, finished, under way
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    said, _ = process.communicate(timeout=20)
    assert process.returncode == 130 and "the same command goes on" in said

    long = short(duration=500)
    assert (tmp_path / f"{long.name()}.unfinished").exists() and not (tmp_path / long.name()).exists()
    ensemble.run([short()], tmp_path, "test")
    assert started(capfd) == 0
    process = ensemble.start(long, tmp_path / f"{long.name()}.unfinished")  # over what is left there
    process.kill()
    process.wait()


@pytest.mark.parametrize("ranks", [1, 2])
def test_a_run_alone_is_measured_and_not_kept(tmp_path, ranks):
    for _ in range(2):
        log, usage = ensemble.alone(short(style="cfpm", n=100), tmp_path, ranks)
        assert f" on {ranks} procs for " in log and ensemble.cpu_seconds(usage) > 0
    assert [file.name for file in tmp_path.iterdir()] == ["lock"]


def test_failing_host_is_named_with_the_end_of_its_log(tmp_path, capfd):
    bad = short(dashpot="perhaps")
    with pytest.raises(SystemExit) as stop:
        ensemble.run([bad], tmp_path, "test")
    said = str(stop.value)
    assert str(bad) in said and "dashpot=perhaps" in said and "ERROR" in said and "unfinished/log" in said
    assert not (tmp_path / bad.name()).exists()


def test_plugin_that_changes_during_a_run_is_noticed(tmp_path, monkeypatch):
    run = short()
    names = iter([run.name(), "another"])
    monkeypatch.setattr(ensemble.Run, "name", lambda self: next(names))
    with pytest.raises(SystemExit, match="changed during the run"):
        ensemble.run([run], tmp_path, "test")
    assert not list(tmp_path.glob("*/run.json"))


def test_results_folder_that_cannot_be_written(tmp_path):
    (tmp_path / "file").write_text("in the way")
    with pytest.raises(SystemExit, match="cannot write to the results folder .*/file/runs"):
        ensemble.run([short()], tmp_path / "file" / "runs", "test")


@pytest.mark.skipif(os.geteuid() == 0, reason="root may write anywhere")
def test_read_only_results_folder(tmp_path):
    tmp_path.chmod(0o500)
    with pytest.raises(SystemExit, match="cannot write to the results folder"):
        ensemble.run([short()], tmp_path, "test")


def test_run_json_tells_what_was_run(tmp_path):
    (result,) = ensemble.run([short(style="cfpm")], tmp_path, "test")
    told = json.loads((result.folder / "run.json").read_text())
    assert told["host"] == "liggghts" and told["variables"]["nt"] == 6 and len(told["plugin"]) == 64
