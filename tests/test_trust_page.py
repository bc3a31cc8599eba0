"""The page on trust: its commands and its program run and say what the page says."""

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from needing import needs
from nivel.cli import main
from nivel.judge.after.report import every_check

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "trust.md").read_text(encoding="utf-8")


def test_the_command_of_the_page_says_its_headline(tmp_path, monkeypatch):
    (command,) = re.findall(r"^```bash\n(.*?)\n^```$", PAGE, re.MULTILINE | re.DOTALL)
    (shown,) = re.findall(r"^```text\n(.*?)\n^```$", PAGE, re.MULTILINE | re.DOTALL)
    monkeypatch.chdir(tmp_path)
    words = command.split()
    done = CliRunner().invoke(main, [*words[1:2], str(ROOT / words[2]), *words[3:], "--no-report"])
    assert done.exit_code == 0, done.output
    assert shown in done.output


@pytest.mark.filterwarnings("ignore")
def test_the_program_of_the_page_runs(verified, monkeypatch, capsys):
    (program,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.MULTILINE | re.DOTALL)
    needs("matplotlib").use("Agg")
    monkeypatch.chdir(ROOT)
    exec(program, {})
    headline, error = capsys.readouterr().out.splitlines()
    assert headline.startswith("within ")
    assert 0.0 < float(error) < 1e-6


def test_every_line_that_is_told_where_it_is_not_green_stands_in_the_table():
    told = re.findall(r"^\| (\w[\w-]*) \|", PAGE, re.MULTILINE)
    quiet = [check for check in every_check() if check.title and (check.quiet or check.blind)]
    assert {check.title.split()[0] for check in quiet} <= set(told)
    assert "Sensitivity" in told


def test_the_table_of_what_each_line_examines_is_that_of_the_checks(monkeypatch):
    monkeypatch.syspath_prepend(str(ROOT / "packaging"))
    from write_trust_table import BEGIN, END, SILENT, written

    assert PAGE.count(BEGIN) == PAGE.count(END) == 1
    assert written(PAGE) == PAGE, "run `python packaging/write_trust_table.py`"
    table = PAGE.partition(BEGIN)[2].partition(END)[0]
    assert all(check.title in table for check in every_check() if check.name not in SILENT)
    assert "| nothing |" in table
