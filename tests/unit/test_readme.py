"""The README's Python code runs as written."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_python_blocks_run(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S | re.M)
    assert blocks
    names: dict[str, object] = {}
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
    given, worst, rate, open_contacts, denser_contacts, dimension = map(float, capsys.readouterr().out.split())
    assert 0 < given <= worst
    assert rate > 0
    assert open_contacts < 2 < denser_contacts
    assert 1.5 < dimension < 2.1
