"""Rosters as offices and learning platforms export them: which column is the id, and what is told of a bad one."""

from __future__ import annotations

from pathlib import Path

import pytest

from graphcam.errors import TaskError
from graphcam.exercises.course.roster import Student, ids_from, read_roster

ROSTERS = {
    "a German office": ("\ufeffMatrikelnummer;Name;Gruppe\r\n214500;Eva Müller;MB-3\r\n", "Matrikelnummer"),
    "Moodle": ("First name,Last name,ID number,Email address\nEva,Müller,214500,e@uni.edu\n", "ID number"),
    "a Russian office": ("№;ФИО;Номер зачётной книжки\n1;Eva Müller;214500\n", "Номер зачётной книжки"),
    "a Chinese office": ("姓名,学号\nEva Müller,214500\n", "学号"),
    "a Vietnamese office": ("STT,MSSV,Họ,Tên\n1,214500,Eva,Müller\n", "MSSV"),
    "English": ("Student number,Name\n214500,Eva Müller\n", "Student number"),
    "Moodle in German": ("Vorname;Nachname;ID-Nummer;E-Mail-Adresse\nEva;Müller;214500;e@uni.edu\n", "ID-Nummer"),
    "one column": ("Matrikelnummer\n214500\n", "Matrikelnummer"),
    "a heading of no system": ("Kennung;Name\n214500;Eva Müller\n", "Kennung"),
}


@pytest.mark.parametrize("heading", ["First name,Last name", "name,group", "ФИО;Группа"])
def test_a_heading_of_names_alone_is_no_student(tmp_path: Path, heading: str):
    path = tmp_path / "roster.csv"
    path.write_text(f"{heading}\nAnna,Berg\nBoris,Petrov\n", encoding="utf-8")
    with pytest.raises(TaskError, match="the column of ids is missing, but must be given; add a column 'id'"):
        read_roster(path)


@pytest.mark.parametrize("system", ROSTERS)
def test_the_ids_of_a_roster_are_found_by_its_headings(tmp_path: Path, system: str):
    text, heading = ROSTERS[system]
    (tmp_path / "roster.csv").write_bytes(text.encode())
    (student,) = read_roster(tmp_path / "roster.csv")
    assert student.id == "214500"
    assert student.name == ("" if system == "one column" else "Eva Müller")
    assert student.email == ("e@uni.edu" if system.startswith("Moodle") else "")
    assert str(ids_from(tmp_path / "roster.csv")) == f"ids from the column '{heading}'"


def test_without_id_numbers_the_addresses_of_moodle_are_the_ids(tmp_path: Path):
    (tmp_path / "roster.csv").write_text("First name,Last name,ID number,Email address\nEva,Dorn,,e@uni.edu\n")
    assert read_roster(tmp_path / "roster.csv") == [Student("e@uni.edu", "Eva Dorn", "e@uni.edu")]
    assert str(ids_from(tmp_path / "roster.csv")) == "ids from the column 'Email address'"


@pytest.mark.parametrize("text", ["7,Anna\n8,Ben\n", "k7,Anna\n8,Ben\n", "anna,x\nben,y\n", "anna\nb7\n"])
def test_where_no_line_is_a_heading_every_line_is_a_student(tmp_path: Path, text: str):
    (tmp_path / "roster.csv").write_text(text)
    assert len(read_roster(tmp_path / "roster.csv")) == 2
    assert str(ids_from(tmp_path / "roster.csv")) == "ids from the first column; no line is a heading"


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (b"id,name\n1,A\n2,B\n\n1,C\n", "line 5: id is '1', but must be another one than '1' in line 2"),
        (b"id,name\n1,A\n,B\n", "line 3: id is '', but must be given; fill in the id of B"),
        (b"PK\x03\x04\x00\xff", "the roster is an Excel workbook or .*; save it as CSV UTF-8"),
        (b"\xd0\xcf\x11\xe0\xa1\xb1", "the roster is an Excel workbook"),
    ],
)
def test_a_bad_roster_is_told_by_its_line(tmp_path: Path, data: bytes, message: str):
    (tmp_path / "roster.csv").write_bytes(data)
    with pytest.raises(TaskError, match=message):
        read_roster(tmp_path / "roster.csv")


def test_what_nobody_sees_is_no_part_of_a_name_or_an_id(tmp_path: Path):
    text = "id,name\n\u200e7\u00a0,\u00a0Анна\u00a0 Берг\u200e\n8,O\u2019Neil\tSe\u0301an\n"
    (tmp_path / "roster.csv").write_text(text, encoding="utf-8")
    assert read_roster(tmp_path / "roster.csv") == [Student("7", "Анна Берг"), Student("8", "O\u2019Neil Se\u0301an")]
