"""What sentences call options of the command line, as keywords of Python: ``--project`` is ``project=True``.

Sentences come from the library, which speaks of the command line. They pass through :func:`in_python` where a user of Python reads them, in
exceptions, warnings and texts; data, which equal the JSON of the command line, do not.
"""

from __future__ import annotations

import re
from typing import Any

#: Options without a value.
FLAGS = frozenset(
    "project keep-integrals orbit second symbolic numbers all zip stop-on-failure compare lowered independent".split()
)
#: Options whose value is one word or expression, which a keyword takes as a text.
WORDS = frozenset("about method precision formulation claims speeds outputs over at period as show sensitivity".split())
#: Options whose value is a name with what it is to be, which a keyword takes as a mapping.
MAPPINGS = frozenset("vary initial kappa".split())
#: Options that are called otherwise in Python, or are methods.
_OTHERWISE = {"as": "notation", "steps": "steps()", "along": "along()", "show": "verdicts", "lowered": "lowered()", "json": "to_dict()"}
#: Commands with an option that makes them another method.
_METHODS = {("linearize", "along"): "along()", ("derive", "steps"): "steps()", ("simulate", "sensitivity"): "sensitivity()"}
#: Sentences of which Python has another one.
_SENTENCES = {"`chetaev study` and `chetaev check` read functionals": "`chetaev.Functional` reads functionals"}
#: Words that go on with a sentence where a value could stand.
_ENGLISH = frozenset("or and says is takes with to decides runs from follows out".split())
#: A value ends before a stop of the sentence, but for three dots.
_OPTION = re.compile(r'--([a-z][a-z-]+)(?:[ =]("[^"]*"|[^\s`,;)]*\.\.\.|[^\s`,;)]*[^\s`,;).:]))?')
_COMMAND = re.compile(r"`chetaev ([a-z]+)((?: [^`]*)?)`")
_NAMED = re.compile(r"([^=\s]+)=(.+)")


def in_python(text: str) -> str:
    """A sentence of the library with keywords and methods in the place of options and commands."""
    if "--" not in text and "`chetaev " not in text:
        return text
    for sentence, ours in _SENTENCES.items():
        text = text.replace(sentence, ours)
    said = re.sub(r"(?:run )?with( `?--set)", r"by\1", text)
    return _OPTION.sub(_keyword, _COMMAND.sub(_method, said))


def of_data(data: Any) -> Any:
    """Data with such sentences in them."""
    if isinstance(data, str):
        return in_python(data)
    if isinstance(data, dict):
        return {key: of_data(own) for key, own in data.items()}
    return [of_data(own) for own in data] if isinstance(data, list) else data


def _method(found: re.Match[str]) -> str:
    command, rest = found[1], found[2]
    for option in re.findall(r"--([a-z-]+)", rest):
        if (command, option) in _METHODS:
            return f"`{_METHODS[command, option]}`"
    keywords = [_keyword(own) for own in _OPTION.finditer(rest)]
    return f"`{command.replace('-', '_')}({', '.join(keywords)})`"


def _keyword(found: re.Match[str]) -> str:
    option, value = found[1], found[2]
    is_value = value is not None and option not in FLAGS and (
        re.search('["=:0-9A-Z{]', value) is not None or option in WORDS and value not in _ENGLISH
    )
    if value is None or not is_value:
        rest = found[0][len(option) + 2 :]
        if option == "set":
            return f"with_values{rest}"
        if option in _OTHERWISE and option != "as":
            return _OTHERWISE[option] + rest
        return f"{option.replace('-', '_')}={'True' if option in FLAGS else '…'}{rest}"
    plain = value.strip('"')
    if option == "set":
        # The name of a source has line and column behind it.
        plain, place, _ = (*re.split(r"(:\d+:\d+$)", plain), "", "")[:3]
        name, _, own = plain.partition("=")
        if name.startswith("initial."):
            return f'with_initial({{"{name[8:]}": {own}}}){place}'
        return f"with_values({plain}){place}"
    name = _OTHERWISE.get(option, option.replace("-", "_"))
    if option in _OTHERWISE and option != "as":
        return name
    pair = _NAMED.fullmatch(plain)
    if option in MAPPINGS and pair is not None:
        return f'{name}={{"{pair[1]}": "{pair[2]}"}}'
    return f'{name}="{plain}"' if option in WORDS or value.startswith('"') else f"{name}={plain}"
