"""What those who carry the project on rely on: commands of CONTRIBUTING.md, one version in all places, the form of commit messages."""

import ast
import importlib.util
import os
import re
import shlex
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest
import yaml

import nivel

ROOT = Path(__file__).parent.parent
CONTRIBUTING = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
RELEASING = (ROOT / "docs" / "releasing.md").read_text(encoding="utf-8")
CHANGELOG = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
SECTIONS = ("Added", "Changed", "Deprecated", "Removed", "Fixed", "Security")
# what the commands leave behind, or fetch from elsewhere
MADE = re.compile(r"\.venv|dist/|/tmp/|site/|PATH$|http")


def commands(page):
    """All commands in the blocks of a page, as words."""
    lines = "\n".join(re.findall(r"^```bash\n(.*?)^```$", page, re.MULTILINE | re.DOTALL)).splitlines()
    return [shlex.split(part) for line in lines if line for part in line.split("&&")]


COMMANDS = [*commands(CONTRIBUTING), *commands(RELEASING)]


@pytest.mark.parametrize("page", [CONTRIBUTING, RELEASING], ids=["contributing", "releasing"])
def test_files_that_the_pages_name_exist(page):
    linked = set(re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", page))
    for target in linked:
        assert (ROOT / "docs" / target).exists(), target
    named = set(re.findall(r"`([\w./-]+/[\w./-]+|[\w-]+\.(?:md|cff|toml))`", page))
    named |= {word.partition("::")[0] for words in COMMANDS for word in words if "/" in word and "=" not in word}
    for word in named:
        if not MADE.search(word) and "my_spring" not in word:
            assert (ROOT / word.strip("./") if word != ".ci/run" else ROOT / word).exists(), word
    assert len(named) > 10


def test_programs_of_the_commands_are_there():
    """Modules and scripts exist; tools of the environment belong to the extra `dev`, to nivel, or are installed on the line before."""
    tools = {"ruff", "pyright", "lint-imports", "mkdocs", "nivel", "pip", "python", "python3", "source"}
    others = {"git", "rm", "cd", "npm", "pre-commit", "twine", ".ci/run"}  # Git, Node.js, and what a line installs
    for words in COMMANDS:
        program = next(word for word in words if "=" not in word)
        assert program in tools | others or MADE.search(program), words
        if words[:2] == ["python", "-m"] and words[2] not in ("venv", "build"):
            assert importlib.util.find_spec(words[2]), words
    for tool, wanted in (("pre-commit", "pre-commit"), ("twine", "twine"), ("build", "build")):
        assert any(words[:2] == ["pip", "install"] and wanted in words for words in COMMANDS), tool


def test_the_tests_that_contributing_runs_exist():
    """The one test is a function of its file without parameters, so it is one; words that select tests select some."""
    lines = [words for words in commands(CONTRIBUTING) if "pytest" in words]
    assert len(lines) >= 5
    path, _, name = lines[0][-1].partition("::")
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    (function,) = [each for each in tree.body if isinstance(each, ast.FunctionDef) and each.name == name]
    assert not function.decorator_list
    for words in lines:
        if "-k" in words:
            word, folder = words[words.index("-k") + 1], next(each for each in words if each.startswith("tests/"))
            files = (ROOT / folder).rglob("test_*.py")
            assert any(
                re.search(rf"^def test_\w*{word}", file.read_text(encoding="utf-8"), re.MULTILINE) for file in files
            )


def test_options_of_the_commands_are_taken():
    for program, *options in (
        ("packaging/build_wheel.py", "folder", "--machine"),
        ("packaging/commit_message.py", "--range"),
        ("tests/mutation_guard.py", "--seed", "--first", "--count", "--list", "--named"),
        ("tests/fuzz.py", "--full"),
    ):
        text = (ROOT / program).read_text(encoding="utf-8")
        for option in options:
            assert f'"{option}"' in text, (program, option)
    assert "--full" in (ROOT / "tests" / "all.py").read_text(encoding="utf-8")
    assert "NIVEL_SITE_PICTURES" in (ROOT / "docs" / "site" / "hooks.py").read_text(encoding="utf-8")
    assert "NUMBA_DISABLE_JIT" in (ROOT / "tests" / "interpreted" / "conftest.py").read_text(encoding="utf-8")


def test_set_up_and_test_command_are_those_of_the_readme():
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert "python3 -m venv .venv && .venv/bin/pip install --editable '.[dev]'" in CONTRIBUTING
    assert ".venv/bin/pip install --quiet --editable '.[dev]' && .venv/bin/python tests/all.py" in readme


def test_the_version_is_the_same_in_all_places():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    newest, date = re.findall(r"^## \[(\d[^\]]*)\] - (\d{4}-\d{2}-\d{2})$", CHANGELOG, re.MULTILINE)[0]
    assert nivel.__version__ == newest == citation["version"]
    assert str(citation["date-released"]) == date
    assert "version" not in PROJECT["project"]
    assert PROJECT["tool"]["hatch"]["version"]["path"] == "src/nivel/__init__.py"


def test_the_change_log_has_the_form_of_keep_a_changelog():
    headings = re.findall(r"^## (.*)$", CHANGELOG, re.MULTILINE)
    assert headings[0] == "[Unreleased]"
    assert all(re.fullmatch(r"\[\d+\.\d+\.\d+\] - \d{4}-\d{2}-\d{2}", each) for each in headings[1:])
    assert set(re.findall(r"^### (.*)$", CHANGELOG, re.MULTILINE)) <= set(SECTIONS)


def test_the_citation_has_what_version_1_2_of_its_format_requires():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert citation["cff-version"] == "1.2.0"
    assert {"message", "title", "authors"} <= citation.keys()
    assert citation["license"] == PROJECT["project"]["license"]
    assert citation["authors"] == PROJECT["project"]["authors"]
    (report,) = citation["references"]
    assert {"type", "title", "authors"} <= report.keys()
    assert report["isbn"] in (ROOT / "docs" / "theory" / "equations.md").read_text(encoding="utf-8")


def test_the_picture_of_the_layers_is_what_is_checked():
    page = (ROOT / "ARCHITECTURE.md").read_text(encoding="utf-8")
    drawn = page.partition("Packages are layers")[2].split("```")[1].strip("\n").split("\n")
    contract = (ROOT / ".importlinter").read_text(encoding="utf-8").partition("layers =\n")[2].partition("\n\n")[0]
    assert [line.split() for line in drawn] == [re.findall(r"nivel\.([\w.]+)", line) for line in contract.split("\n")]


def test_no_address_is_invented():
    """The only one of the project is that of its package."""
    assert PROJECT["project"]["urls"] == {"Homepage": "https://pypi.org/project/nivel/"}
    allowed = ("pypi.org/project/nivel", "keepachangelog.com/", "semver.org/")
    files = ["CONTRIBUTING.md", "SECURITY.md", "CHANGELOG.md", "CITATION.cff", "docs/releasing.md", "docs/versions.md"]
    for path in [ROOT / each for each in files] + sorted((ROOT / ".github").rglob("*.yml")):
        for address in re.findall(r"https?://([^\s)`]+)", path.read_text(encoding="utf-8")):
            assert address.startswith(allowed), (path, address)


@pytest.mark.parametrize("path", sorted((ROOT / ".github").rglob("*.yml")), ids=lambda path: path.name)
def test_files_of_the_host_are_read(path):
    assert isinstance(yaml.safe_load(path.read_text(encoding="utf-8")), dict)


def test_continuous_integration_runs_all_tests_on_one_python_and_some_on_the_others():
    jobs = yaml.safe_load((ROOT / ".github" / "workflows" / "ci.yml").read_text(encoding="utf-8"))["jobs"]
    stated = {each.rpartition(" ")[2] for each in PROJECT["project"]["classifiers"] if re.search(r":: 3\.\d+$", each)}
    (image,) = re.findall(r"^python:(3\.\d+)-", jobs["full"]["container"])
    assert {image, *jobs["smoke"]["strategy"]["matrix"]["python"]} == stated
    assert image == PROJECT["project"]["requires-python"].removeprefix(">=")
    assert {"run": ".ci/run"} in jobs["full"]["steps"]
    lines = [step["run"] for job in jobs.values() for step in job["steps"] if "run" in step]
    for path in re.findall(r"(?:packaging|tests|examples)/[\w./-]+", "\n".join(lines)):
        assert (ROOT / path).exists(), path
    assert any("packaging/build_wheel.py" in line for line in lines)


def test_issue_forms_ask_for_what_a_wrong_result_needs():
    folder = ROOT / ".github" / "ISSUE_TEMPLATE"
    forms = {path.stem: yaml.safe_load(path.read_text(encoding="utf-8")) for path in folder.glob("*.yml")}
    assert set(forms) == {"config", "wrong-result", "crash", "wish"}
    for name in ("wrong-result", "crash", "wish"):
        assert {"name", "description", "body"} <= forms[name].keys()
        ids = [each["id"] for each in forms[name]["body"]]
        assert len(ids) == len(set(ids))
    asked = {each["id"] for each in forms["wrong-result"]["body"] if each["validations"]["required"]}
    assert {"machine", "explain", "version"} <= asked


def test_hooks_are_local_and_check_what_the_tests_check():
    hooks = yaml.safe_load((ROOT / ".pre-commit-config.yaml").read_text(encoding="utf-8"))
    (repository,) = hooks["repos"]
    assert repository["repo"] == "local"
    assert all(hook["language"] == "system" for hook in repository["hooks"])
    entries = " ".join(hook["entry"] for hook in repository["hooks"])
    for part in ("ruff check", "ruff format --check", "lint-imports", "packaging/commit_message.py"):
        assert part in entries
    assert set(hooks["default_install_hook_types"]) == {"pre-commit", "commit-msg"}


GOOD = "Ropes end a step where they become slack\n\nA step across that instant had an error of order one.\n"


@pytest.mark.parametrize(
    ("message", "told"),
    [
        (GOOD, ""),
        ("x" * 72 + "\n\nwhy\n", ""),
        ("x" * 73 + "\n\nwhy\n", "the subject has 73 characters, at most 72 fit"),
        ("Ropes end a step\n", "there is no body"),
        ("Ropes end a step\n\n# Please enter the commit message\n", "there is no body"),
        ("Ropes end a step\n\nSigned-off-by: A <a@b>\n", "there is no body"),
        ("Ropes end a step\nwhere they become slack\n", "the second line is not empty"),
        ("# comment alone\n", "the message is empty"),
        ("Short\n\n# ------------------------ >8 ------------------------\ndiff --git a b\n", "there is no body"),
        ("Merge: friction of ropes\n", "there is no body"),
    ],
)
def test_messages_of_another_form_are_refused(message, told):
    specification = importlib.util.spec_from_file_location("commit_message", ROOT / "packaging" / "commit_message.py")
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    said = module.faults(module.without_comments(message), merge=False)
    assert len(said) == (told != "")
    assert told in "".join(said)


@pytest.fixture
def repository(tmp_path):
    """A new repository, and a function that runs Git in it."""
    kept = {key: value for key, value in os.environ.items() if not key.startswith("GIT_")}
    who = ["-c", "user.name=nobody", "-c", "user.email=nobody@localhost", "-c", "commit.gpgsign=false"]

    def git(*words):
        subprocess.run(["git", *who, *words], cwd=tmp_path, env=kept, check=True, capture_output=True)

    git("init", "--quiet", "--initial-branch", "main")
    return tmp_path, git


def checked(folder, *arguments, **files):
    """Exit code and output of the check, run in `folder`."""
    for name, text in files.items():
        (folder / name).write_text(text, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, ROOT / "packaging" / "commit_message.py", *arguments],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stderr


def test_the_hook_refuses_a_commit_and_merges_name_their_subject(repository):
    """A file as the hook gets it, then that of a merge, then a range with one in it."""
    folder, git = repository
    assert checked(folder, "MESSAGE", MESSAGE=GOOD) == (0, "")
    assert checked(folder, "MESSAGE", MESSAGE="No body\n")[0] == 1
    git("commit", "--allow-empty", "-m", GOOD)
    git("switch", "--quiet", "-c", "ropes")
    git("commit", "--allow-empty", "-m", "No body")
    git("switch", "--quiet", "main")
    git("merge", "--no-ff", "--no-commit", "ropes")
    assert checked(folder, "MESSAGE", MESSAGE="Merge: friction of ropes\n") == (0, "")
    code, said = checked(folder, "MESSAGE", MESSAGE="Merge branch 'ropes'\n")
    assert code == 1
    assert "does not name the subject of the merge" in said
    git("commit", "-m", "Merge: friction of ropes")
    code, said = checked(folder, "--range", "main~1..main")
    assert code == 1
    assert said.count("there is no body") == 1
    code, said = checked(folder, "--range", "nothing..main")
    assert code == 1
    assert "nothing..main" in said
    assert "Traceback" not in said
