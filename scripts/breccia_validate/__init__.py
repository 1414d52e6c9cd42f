"""Validation studies. Each module of this package that has PAGES adds its pages; see study.py for what a study is."""
import importlib
import pkgutil

from .report import make, write_pages
from .runner import RunFailed, Runner
from .study import Case, Outcome, Page, Row, Study

__all__ = ["Case", "Outcome", "Page", "Row", "RunFailed", "Runner", "Study", "all_pages", "chosen", "make", "write_pages"]


def all_pages():
    """Pages of all modules, in the order of their names."""
    pages = []
    for module in sorted(info.name for info in pkgutil.iter_modules(__path__)):
        pages += getattr(importlib.import_module(f"{__name__}.{module}"), "PAGES", [])
    return pages


def chosen(pages, names):
    """Studies that the names of studies or pages stand for; KeyError for a name that is neither."""
    studies = {study.name: [study] for page in pages for study in page.studies}
    of_page = {page.name: page.studies for page in pages}
    wanted = [study for name in names for study in studies.get(name) or of_page[name]]
    return list(dict.fromkeys(wanted)) if names else [study for page in pages for study in page.studies]
