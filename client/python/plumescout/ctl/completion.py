# SPDX-FileCopyrightText: PlumeScout contributors
# SPDX-License-Identifier: Apache-2.0
"""Completion of commands and options, for bash and zsh."""

import argparse

_BASH = """\
_{name}() {{
  local word="${{COMP_WORDS[COMP_CWORD]}}" path="" i
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$path ${{COMP_WORDS[i]}}" in
      {paths}) path="$path ${{COMP_WORDS[i]}}" ;;
    esac
  done
  local words=""
  case "$path" in
{cases}
  esac
  COMPREPLY=($(compgen -W "$words" -- "$word"))
}}
complete -o default -F _{name} {name}
"""
_ZSH = "autoload -U +X bashcompinit && bashcompinit\n"


def script(parser, shell):
    """Asks no server: names of missions are not completed."""
    words: dict[str, list[str]] = {}
    _collect(parser, "", words)
    name = parser.prog
    cases = "\n".join(
        f'    "{path}") words="{" ".join(choices)}" ;;' for path, choices in sorted(words.items())
    )
    paths = " | ".join(f'"{path}"' for path in sorted(words) if path)
    text = _BASH.format(name=name, paths=paths, cases=cases)
    return text if shell == "bash" else _ZSH + text


def _collect(parser, path, words):
    """words: what may follow each sequence of commands."""
    choices = []
    for action in parser._actions:
        choices += action.option_strings
        if isinstance(action, argparse._SubParsersAction):
            for command, subparser in action.choices.items():
                choices.append(command)
                _collect(subparser, f"{path} {command}", words)
        elif not action.option_strings and action.choices:
            choices += action.choices
    words[path] = choices
