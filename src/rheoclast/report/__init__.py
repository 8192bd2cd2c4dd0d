"""Results of the command line as one page for any browser: key figures, tables, charts, and the aggregate in 3-D."""

from rheoclast.report.page import write_report

__all__ = ["write_report"]
