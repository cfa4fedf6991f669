"""What packages of IMS share: documents of a namespace, and the manifest that names the files.

See IMS Content Packaging, version 1.1.
"""

import zipfile
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

ENTRY_DATE = (1980, 1, 1, 0, 0, 0)
"""Date of all files, the first that a zip can tell: the same files make the same zip."""


def write_zip(path: Path, files: Mapping[str, bytes]) -> None:
    """Write files, by their names in it, into a zip."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, data in files.items():
            file = zipfile.ZipInfo(name, ENTRY_DATE)
            file.external_attr = 0o644 << 16
            archive.writestr(file, data, zipfile.ZIP_DEFLATED)


MANIFEST_FILE = "imsmanifest.xml"


class Resource(NamedTuple):
    """A file of a package, of some kind, and what else it needs, by identifiers."""

    identifier: str
    kind: str
    path: str
    needs: Sequence[str] = ()


def root(name: str, namespace: str, schema: str, attributes: Mapping[str, str]) -> Element:
    """The root of a document whose names are of one namespace.

    schema : where the schema of the namespace is
    """
    instance = {"xmlns:xsi": "http://www.w3.org/2001/XMLSchema-instance"}
    return Element(name, {"xmlns": namespace, **instance, "xsi:schemaLocation": f"{namespace} {schema}", **attributes})


def manifest_of(manifest: Element, schema: str, version: str, resources: Iterable[Resource]) -> bytes:
    """The manifest, whose root is given, with the name of its schema and all resources."""
    metadata = SubElement(manifest, "metadata")
    SubElement(metadata, "schema").text = schema
    SubElement(metadata, "schemaversion").text = version
    SubElement(manifest, "organizations")
    listed = SubElement(manifest, "resources")
    for each in resources:
        resource = SubElement(listed, "resource", identifier=each.identifier, type=each.kind, href=each.path)
        SubElement(resource, "file", href=each.path)
        for need in each.needs:
            SubElement(resource, "dependency", identifierref=need)
    return xml_bytes(manifest)


def xml_bytes(document: Element) -> bytes:
    """The document as a file holds it, indented."""
    indent(document)
    return b'<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(document, encoding="utf-8") + b"\n"
