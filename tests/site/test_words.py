"""Words that people read are the standard ones of the field: home-made terms stand in no page and no message."""

import ast
import inspect
import re
from pathlib import Path

import click
import pytest

import nivel
from nivel.cli import COMMANDS, main

ROOT = Path(__file__).parents[2]
PAGES = [*sorted((ROOT / "docs").rglob("*.md")), ROOT / "README.md"]

# what is not written, and what is written in its place
HOME_MADE = {
    r"feels?|felt": "carries, takes up",
    r"told": "reported",
    r"in vain": "to something that does not exist",
    r"heeds?|heeded": "respects",
    r"nobody|somebody": "no one is needed: say what happens",
    r"gives? way": "yields, deforms",
    r"goes? before": "overrides",
    r"thick fluid": "overdamped relaxation",
    r"turned too far": "the rotation in a step is too large",
    r"march(es|ed|ing)?": "advances",
    r"settings? at rest": "ignored settings",
    r"turn freedoms": "rotational degrees of freedom",
    r"(take|takes|taken) hold of": "attaches to, acts on",
    r"as it likes": "any, without limit",
    r"for ever": "without end",
    r"astray": "diverges",
    r"in one go": "at once",
    r"alike": "in the same way, similar",
    r"is worth": "how exact it is",
    r"in earnest": "by an amount that matters",
    r"wrong alike": "have the same error",
    r"freedoms": "degrees of freedom",
    r"cannot be had": "cannot be reached",
    r"a blow": "an impact",
    r"on and on": "without end",
    r"in its stride": "without difficulty: say what it costs",
    r"crawls?": "takes very short steps",
    r"nothing stands": "is missing",
    r"home-?made": "own",
    r"wished": "commanded, wanted",
    r"plain yes": "green",
    r"nothing pulls back": "without stiffness",
    r"unwilling": "weight",
    r"nothing but": "only",
    r"but for": "except",
    r"(?<!there )is none": "is not a",
    r"whoever": "the author, the user: say who",
    r"(written )?(out )?on the spot": "inside the element",
    r"turned round": "reversed",
    r"half balls?": "hemispheres",
    r"counts? the other way": "changes its sign",
    r"seen from the (folder of the )?machine file": "relative to the machine file",
    r"(die|dies|dying|died) out": "decays",
    r"forces? left over": "unbalanced forces",
    r"there and back": "round trip",
    r"habits?": "features, differences",
    r"to be played": "animation",
    r"turns too far": "rotates too far",
    r"as everywhere": "as for other commands",
    r"throws? .{1,20} apart": "the force would be huge: say what happens",
    r"round-off rules": "round-off dominates",
    r"damped away": "damped numerically",
    r"rounded away": "below round-off",
    r"on either way": "in more than one way",
    r"fixed steps? stays? (fixed|as they are)": "is fixed: say what to use",
}
# besides these, of pages
IN_PAGES = {
    r"lets? go|let go": "releases",
    r"held against|hold it against": "compared with, checked against",
    r"passed over": "ignored",
    r"wants to be": "should be",
    r"looked (at|for)": "examined, searched for",
    r"what is known when": "order of computation",
}


def home_made(text, words):
    """The home-made terms of a text: line, word, and what is written in its place."""
    for found in re.finditer(r"\b(" + "|".join(f"(?:{word})" for word in words) + r")\b", text):
        instead = next(each for word, each in words.items() if re.fullmatch(word, found[1]))
        yield text.count("\n", 0, found.start()) + 1, f"`{found[1]}`, write: {instead}"


def prose(text):
    """A page without its code."""
    return re.sub(r"`[^`\n]*`|\]\([^)]*\)", "", re.sub(r"^```.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL))


def messages(path):
    """Texts of a module that people may read: constants of more than one word which are no docstrings."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    first = [node.body[0] for node in ast.walk(tree) if isinstance(node, documented) and node.body]
    docs = {id(each.value) for each in first if isinstance(each, ast.Expr)}
    for node in ast.walk(tree):
        if (
            isinstance(node, ast.Constant)
            and isinstance(node.value, str)
            and " " in node.value
            and id(node) not in docs
        ):
            yield node.lineno, node.value


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_no_page_has_a_home_made_term(path):
    wrong = [
        f"{path.name}: line {line} of the prose: {what}"
        for line, what in home_made(prose(path.read_text("utf-8")), HOME_MADE | IN_PAGES)
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize("name", COMMANDS)
def test_no_help_of_a_command_has_a_home_made_term(name):
    command = main.get_command(click.Context(main), name)
    text = command.get_help(click.Context(command, info_name=name))
    wrong = [what for _, what in home_made(" ".join(text.split()), HOME_MADE | IN_PAGES)]
    assert not wrong, "\n".join(wrong)


def test_no_message_has_a_home_made_term():
    wrong = []
    for path in sorted((ROOT / "src" / "nivel").rglob("*.py")):
        for line, text in messages(path):
            wrong += [f"{path.relative_to(ROOT)}:{line}: {what}" for _, what in home_made(prose(text), HOME_MADE)]
    assert not wrong, "\n".join(wrong)


def test_no_text_of_a_report_has_a_home_made_term():
    wrong = []
    for path in sorted((ROOT / "src" / "nivel").rglob("*.j2")) + sorted(
        (ROOT / "src" / "nivel" / "report").glob("*.js")
    ):
        text = re.sub(r"\{[{%#].*?[}%#]\}|<[^>]*>", " ", path.read_text("utf-8"))
        wrong += [f"{path.name}:{line}: {what}" for line, what in home_made(text, HOME_MADE)]
    assert not wrong, "\n".join(wrong)


def public():
    """What `import nivel` offers, and the public methods of its classes, by name."""
    for name in nivel.__all__:
        thing = getattr(nivel, name)
        yield name, thing
        if inspect.isclass(thing):
            methods = inspect.getmembers(thing, lambda each: inspect.isfunction(each) or isinstance(each, property))
            yield from ((f"{name}.{each}", method) for each, method in methods if not each.startswith("_"))


def test_no_docstring_of_a_public_name_has_a_home_made_term():
    wrong = [
        f"{name}: {what}"
        for name, thing in public()
        for _, what in home_made(prose(inspect.getdoc(thing) or ""), HOME_MADE)
    ]
    assert not wrong, "\n".join(wrong)


def test_docstrings_of_modules_begin_with_what_the_module_is():
    """A noun phrase of the textbooks, and no question."""
    question = re.compile(r"(what|how|where|whether|which|when|why|who)\b", re.IGNORECASE)
    asking = []
    for path in (ROOT / "src" / "nivel").rglob("*.py"):
        text = ast.get_docstring(ast.parse(path.read_text(encoding="utf-8"))) or ""
        if question.match(text):
            asking.append(path)
    assert not asking
