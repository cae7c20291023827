"""gelpump: a replication of Webber & Montenegro-Johnson (2025) on responsive hydrogel pumps."""

__version__ = "0.1.0"
