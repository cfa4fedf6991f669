"""What packages of IMS share: documents of a namespace, and the manifest that names the files.

See IMS Content Packaging, version 1.1.
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple
from xml.etree.ElementTree import Element, SubElement, indent, tostring

MANIFEST = "imsmanifest.xml"


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
