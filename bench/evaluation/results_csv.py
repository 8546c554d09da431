"""Reads what tessera_evaluate wrote."""

import csv
import pathlib


class Row:
    """A row of a figure's file. Numbers that are missing, as of a trial that failed, are None."""

    def __init__(self, fields):
        self.fields = fields

    def __getitem__(self, column):
        return self.fields[column]

    def number(self, column):
        text = self.fields[column]
        return float(text) if text else None

    def count(self, column):
        text = self.fields[column]
        return int(text) if text else None

    def mebibytes(self, column):
        """None where the renderer did not count that purpose."""
        value = self.number(column)
        return value / 2**20 if value else None

    @property
    def failed(self):
        return not self.fields["frame_ms"]

    @property
    def error(self):
        return self.fields["error"]

    @property
    def view(self):
        return self["scene"] + ("@" + self["camera"] if self["camera"] else "")

    @property
    def method(self):
        return self["method"].upper()

    def per_second(self, count, milliseconds):
        """Millions a second."""
        time = self.number(milliseconds)
        return self.number(count) / time / 1000 if time else None


class Results:
    """The files of one evaluation. Figures that were not measured have no rows."""

    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        machine = self._read("machine")
        if not machine:
            raise FileNotFoundError(f"{self.folder}: no machine.csv in it; let tessera_evaluate write there first")
        self.machine = {fields["name"]: fields["value"] for fields in machine}

    def _read(self, name):
        path = self.folder / f"{name}.csv"
        if not path.exists():
            return []
        with open(path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def rows(self, figure):
        return [Row(fields) for fields in self._read(figure)]

    def loads(self, figure):
        """Ranges of each work-group, by view and mode in the file's order."""
        loads = {}
        for fields in self._read(f"{figure}_load"):
            view = fields["scene"] + ("@" + fields["camera"] if fields["camera"] else "")
            loads.setdefault((view, fields["mode"]), []).append(int(fields["ranges"]))
        return loads

    @property
    def device(self):
        units = self.machine["compute_units"]
        return f"{self.machine['device']} ({self.machine['type']}, {units} compute units, driver {self.machine['driver']})"


def unique(values):
    """Each once, in the order of first appearance."""
    return list(dict.fromkeys(values))
