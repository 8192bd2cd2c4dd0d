"""The README's Python code runs as written."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_python_blocks_run(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S | re.M)
    assert blocks
    for block in blocks:
        exec(compile(block, "README.md", "exec"), {})
    printed = [float(line) for line in capsys.readouterr().out.split()]
    given, worst, rate = printed
    assert 0 < given <= worst
    assert rate > 0
