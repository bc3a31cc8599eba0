"""Words of machine files and messages: vocabulary of other programs, sentences, lines that a message proposes."""
