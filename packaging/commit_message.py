"""The form of commit messages: a subject of at most 72 characters, an empty line, and a body that says why.

    python packaging/commit_message.py FILE           the message in a file, as Git's hook commit-msg names it
    python packaging/commit_message.py --range A..B   the messages of all commits of a range

A merge needs no body; its subject names what was merged: `Merge: friction of ropes`. Exit code 1: a message has another form.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

LONGEST = 72
SCISSORS = (
    "# ------------------------ >8 ------------------------"  # what `git commit --verbose` puts before the changes
)
TRAILER = re.compile(r"(Signed-off-by|Co-authored-by|Reviewed-by|Change-Id): ", re.IGNORECASE)
# Git's own subjects of merges, which say only where something came from
UNNAMED = re.compile(r"Merge(?: (?:remote-tracking )?(?:branch|commit|tag|pull request)\b.*)?")


def faults(message: str, *, merge: bool) -> list[str]:
    """What is wrong with the text of a message, in sentences; empty where nothing is."""
    subject, *rest = message.strip("\n").splitlines() or [""]
    out = []
    if not subject.strip():
        return ["the message is empty; write a subject, an empty line and why the change is made"]
    if len(subject) > LONGEST:
        out.append(f"the subject has {len(subject)} characters, at most {LONGEST} fit; move the details to the body")
    if rest and rest[0].strip():
        out.append("the second line is not empty; the body begins in the third line")
    if merge:
        if UNNAMED.fullmatch(subject):
            out.append(
                f"`{subject}` does not name the subject of the merge; write for example `Merge: friction of ropes`"
            )
    elif not any(line.strip() and not TRAILER.match(line) for line in rest):
        out.append("there is no body; after an empty line, say why the change is made")
    return out


def without_comments(text: str) -> str:
    """What Git keeps of a file that was edited: no comments, nothing behind the scissors."""
    kept = text.partition(SCISSORS)[0]
    return "\n".join(line for line in kept.splitlines() if not line.startswith("#")).strip("\n")


def git(*arguments: str) -> str:
    """The output of a command of Git; where it fails, the check ends with what Git says."""
    done = subprocess.run(["git", *arguments], check=False, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr.strip())
    return done.stdout


def merging() -> bool:
    """Whether the commit that is being made is a merge."""
    return Path(git("rev-parse", "--git-path", "MERGE_HEAD").strip()).exists()


def messages_of(commits: str) -> list[tuple[str, str, bool]]:
    """Name, message and whether it is a merge, of the commits of a range."""
    lines = [line.split() for line in git("rev-list", "--parents", commits).splitlines()]
    return [(each[0][:8], git("log", "-1", "--format=%B", each[0]), len(each) > 2) for each in lines]


def main() -> None:
    """Check the message of a file, or those of a range."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    what = parser.add_mutually_exclusive_group(required=True)
    what.add_argument("file", nargs="?", type=Path)
    what.add_argument("--range", metavar="A..B")
    chosen = parser.parse_args()
    if chosen.range:
        found = messages_of(chosen.range)
    else:
        found = [("commit message", without_comments(chosen.file.read_text(encoding="utf-8")), merging())]
    told = [f"{name}: {fault}" for name, message, merge in found for fault in faults(message, merge=merge)]
    if told:
        sys.exit("\n".join(told))


if __name__ == "__main__":
    main()
