"""The README's Python code runs as written."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[2]


def test_python_blocks_run(monkeypatch, capsys):
    monkeypatch.chdir(ROOT)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S | re.M)
    assert blocks
    names: dict[str, object] = {}
    printed = []
    for block in blocks:
        exec(compile(block, "README.md", "exec"), names)
        printed.append(capsys.readouterr().out)
    first, breakup, turbulent, generated = printed
    given, worst, rate, split_rate, fragments = map(float, first.split())
    assert 0 < given <= worst
    assert 0 < rate <= split_rate
    assert fragments == 2
    assert breakup.startswith("crack ")
    assert len(breakup.splitlines()) == 8
    assert turbulent.startswith("LargestLoad(")
    assert "BreakageRate(rate=" in turbulent
    open_contacts, denser_contacts, dimension = map(float, generated.split())
    assert open_contacts < 2 < denser_contacts
    assert 1.5 < dimension < 2.1
