"""The command's flags in messages, as keywords of ``load``."""

from __future__ import annotations

import re

# Commands stay as they are. A value that follows a flag is a name, no word of the sentence.
_FLAG = re.compile(
    r"(?P<command>`dalembert [^`]*`)|--(?P<others>lock-others) 0"
    r"|--lock (?P<joint>(?!or\b|and\b)[^\s=:,]+)(=(?P<at>[^\s,;:]+))?"
    r"|--(?P<name>base|tip|without|name|sincos|scene|effort) (?!or\b|and\b)(?P<value>[^\s,;:`]+)"
    r"|--(?P<bare>[a-z]+(-[a-z]+)*)"
)


def keywords(message: str) -> str:
    """Write ``--tip hand`` as ``tip="hand"``, ``--lock elbow=0`` as ``lock={"elbow": 0}``."""

    def keyword(found: re.Match[str]) -> str:
        if found["command"]:
            return found["command"]
        if found["others"]:
            return 'lock="*"'
        if found["joint"]:
            return f'lock={{"{found["joint"]}": {found["at"] or "…"}}}'
        if found["name"]:
            return f'{found["name"]}="{found["value"]}"'
        return found["bare"].replace("-", "_") + "="

    return _FLAG.sub(keyword, message)
