"""Catalogs of gettext against Babel, which writes and reads them too."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path

import pytest
from babel.messages.catalog import Catalog as Written
from babel.messages.pofile import read_po, write_po
from hypothesis import given, strategies as st

import graphcam
from graphcam.language import read_catalog

pytestmark = pytest.mark.slow

RUSSIAN = Path(graphcam.__file__).parent / "data" / "languages" / "ru.po"
TEXTS = st.text(st.characters(codec="utf-8", exclude_categories=["Cc", "Zl", "Zp", "Cs"]) | st.sampled_from('\n\t\\"'))


def told(written: Written) -> dict[tuple[str, str], tuple[str, ...]]:
    """What Babel reads, as the package has it."""
    found = {}
    for message in written:
        one = message.id if isinstance(message.id, str) else message.id[0]
        forms = (message.string,) if isinstance(message.string, str) else tuple(message.string)
        if one and all(forms) and not message.fuzzy:
            found[message.context or "", one] = forms
    return found


def test_the_russian_catalog_is_read_as_babel_reads_it():
    with RUSSIAN.open("rb") as file:
        written = read_po(file, locale="ru")
    read = read_catalog(RUSSIAN.read_text(encoding="utf-8"))
    assert read.told == told(written)
    assert len(read.told) > 1000


@given(st.dictionaries(st.tuples(TEXTS.filter(bool), st.sampled_from(["", "here"])), st.tuples(TEXTS, st.booleans())))
def test_whatever_babel_writes_is_read(messages):
    written = Written(locale="de")
    for (text, context), (translation, fuzzy) in messages.items():
        written.add(text, translation, context=context or None, flags=["fuzzy"] if fuzzy else [])
    file = BytesIO()
    write_po(file, written)
    assert read_catalog(file.getvalue().decode()).told == told(written)


PLURALS = """
msgid ""
msgstr ""
"Plural-Forms: nplurals=3; "
"plural=(n%10==1 && n%100!=11 ? 0 : n%10>=2 && n%10<=4 && (n%100<10 || n%100>=20) ? 1 : 2);\\n"

#~ msgid "part"
#~ msgstr "no more"

msgid "{count} part"
msgid_plural "{count} parts"
msgstr[0] "деталь"
msgstr[1] "детали"
msgstr[2] "деталей"
"""


@pytest.mark.parametrize(("count", "form"), [(1, "деталь"), (3, "детали"), (12, "деталей"), (21, "деталь")])
def test_the_rule_of_plurals_is_the_catalogs_own(count, form):
    assert read_catalog(PLURALS).plural_translation("{count} part", "{count} parts", count) == form


def test_what_is_not_translated_stays_english():
    catalog = read_catalog(PLURALS)
    assert catalog.translation("part") == "part"
    assert [catalog.plural_translation("one", "many", count) for count in (1, 2)] == ["one", "many"]


def test_a_catalog_without_a_rule_counts_as_english_does():
    catalog = read_catalog('msgid "one"\nmsgid_plural "many"\nmsgstr[0] "eins"\nmsgstr[1] "viele"\n')
    assert [catalog.plural_translation("one", "many", count) for count in (0, 1, 2)] == ["viele", "eins", "viele"]
