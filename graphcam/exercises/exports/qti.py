"""A package of QTI 2.1: one item a variant, and a test that draws one of them.

An item has a blank for every number.  Its response processing compares the number with the key and its tolerance, then
with what the catalogued mistakes answer, which earn nothing and have a feedback.  See the assessment test, section and
item information model of IMS Question and Test Interoperability, version 2.1, and IMS Content Packaging, version 1.1.
"""

from collections.abc import Sequence
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.exports.content_package import MANIFEST_FILE, Resource, manifest_of, root, write_zip, xml_bytes
from graphcam.exercises.exports.question_parts import (
    PRINT_ADVICE,
    RIGHT_FEEDBACK,
    SEPARATE_HAND_IN,
    WRONG_FEEDBACK,
    IssuedVariant,
    check_numbers,
    mistaken,
    question_body,
    short_identifier,
    variant_identifier,
    worksheet_pdf,
)

QTI_NAMESPACE = "http://www.imsglobal.org/xsd/imsqti_v2p1"
CONTENT_NAMESPACE = "http://www.imsglobal.org/xsd/imscp_v1p1"
SCHEMA_LOCATIONS = {
    QTI_NAMESPACE: "http://www.imsglobal.org/xsd/qti/qtiv2p1/imsqti_v2p1.xsd",
    CONTENT_NAMESPACE: "http://www.imsglobal.org/xsd/qti/qtiv2p1/qtiv2p1_imscpv1p2_v1p0.xsd",
}
"""The address of the schema of each namespace."""
TEST_FILE = "test.xml"


def write_package(path: Path, exercise: Exercise, issued: Sequence[IssuedVariant]) -> None:
    """Write the package, a zip, of several variants.

    Raises
    ------
    TaskError : no answer of the exercise is a number
    """
    check_numbers(exercise)
    names = [variant_identifier(each) for each in issued]
    files = {MANIFEST_FILE: manifest_xml(exercise, names), TEST_FILE: assessment_xml(exercise, names)}
    for name, each in zip(names, issued, strict=True):
        files |= {f"{name}.xml": item_xml(exercise, each), f"{name}.pdf": worksheet_pdf(each)}
    write_zip(path, files)


def item_xml(exercise: Exercise, issued: IssuedVariant) -> bytes:
    """One variant: what is asked, keys, and how it is marked."""
    name, tell = variant_identifier(issued), exercise.tell
    title = f"{exercise.title}: {folder_name(issued.student.id)}"
    item = _root("assessmentItem", QTI_NAMESPACE, identifier=name, title=title, adaptive="false", timeDependent="false")
    item.set("xml:lang", exercise.language)
    numbers = [asked for asked in exercise.answers if asked.kind == "number"]
    for asked in numbers:
        declared = SubElement(item, "responseDeclaration", _variable(_response(asked), "single", "float"))
        correct = SubElement(declared, "correctResponse")
        SubElement(correct, "value").text = repr(issued.answer_key.keys[asked.name].expected.value)
    most = repr(sum(asked.marks for asked in numbers))
    score = SubElement(item, "outcomeDeclaration", _variable("SCORE", "single", "float") | {"normalMaximum": most})
    SubElement(SubElement(score, "defaultValue"), "value").text = "0"
    SubElement(item, "outcomeDeclaration", _variable("FEEDBACK", "multiple", "identifier"))
    body = SubElement(item, "itemBody")
    SubElement(body, "p").text = instructions(issued.variant)
    link = SubElement(SubElement(body, "p"), "a", href=f"{name}.pdf", type="application/pdf")
    link.text = tell(PRINT_ADVICE)
    for asked in exercise.answers:
        paragraph = SubElement(body, "p")
        paragraph.text = question_body(exercise, issued.answer_key, asked) + " "
        if asked.kind == "number":
            SubElement(paragraph, "textEntryInteraction", responseIdentifier=_response(asked), expectedLength="12")
        else:
            paragraph.text += tell(SEPARATE_HAND_IN)
    processing = SubElement(item, "responseProcessing")
    for asked in numbers:
        _mark(item, processing, exercise, issued, asked)
    return xml_bytes(item)


def _mark(item: Element, processing: Element, exercise: Exercise, issued: IssuedVariant, asked: AskedAnswer) -> None:
    """The condition that marks one number, and the feedback that belongs to its branches."""
    key, name, tell = issued.answer_key.keys[asked.name], _response(asked), exercise.tell
    condition = SubElement(processing, "responseCondition")
    branch = SubElement(condition, "responseIf")
    equal = SubElement(branch, "equal", toleranceMode="absolute", tolerance=repr(key.tolerance))
    SubElement(equal, "variable", identifier=name)
    SubElement(equal, "correct", identifier=name)
    total = SubElement(SubElement(branch, "setOutcomeValue", identifier="SCORE"), "sum")
    SubElement(total, "variable", identifier="SCORE")
    SubElement(total, "baseValue", baseType="float").text = repr(asked.marks)
    _add_feedback(item, branch, f"{asked.name}: {tell(RIGHT_FEEDBACK)}")
    for wrong in mistaken(exercise, issued.answer_key, asked):
        branch = SubElement(condition, "responseElseIf")
        equal = SubElement(branch, "equal", toleranceMode="absolute", tolerance=repr(wrong.tolerance))
        SubElement(equal, "variable", identifier=name)
        SubElement(equal, "baseValue", baseType="float").text = repr(wrong.value)
        _add_feedback(item, branch, f"{asked.name}: {tell(wrong.said)}")
    # An empty blank is equal to nothing; it is not far off either.
    branch = SubElement(condition, "responseElseIf")
    SubElement(SubElement(SubElement(branch, "not"), "isNull"), "variable", identifier=name)
    _add_feedback(item, branch, f"{asked.name}: {tell(WRONG_FEEDBACK)}")


def _add_feedback(item: Element, branch: Element, text: str) -> None:
    identifier = f"F{len(item.findall('modalFeedback')) + 1}"
    shown = SubElement(SubElement(branch, "setOutcomeValue", identifier="FEEDBACK"), "multiple")
    SubElement(shown, "variable", identifier="FEEDBACK")
    SubElement(shown, "baseValue", baseType="identifier").text = identifier
    # It stands at the end of the item, behind the processing.
    SubElement(item, "modalFeedback", outcomeIdentifier="FEEDBACK", showHide="show", identifier=identifier).text = text


def assessment_xml(exercise: Exercise, names: Sequence[str]) -> bytes:
    """The test: of all variants one is drawn; its score is that of the test."""
    test = _root("assessmentTest", QTI_NAMESPACE, identifier=_test_name(exercise, names), title=exercise.title)
    SubElement(test, "outcomeDeclaration", _variable("SCORE", "single", "float"))
    part = SubElement(test, "testPart", identifier="part", navigationMode="nonlinear", submissionMode="individual")
    section = SubElement(part, "assessmentSection", identifier="variants", title=exercise.title, visible="false")
    SubElement(section, "selection", select="1")
    for name in names:
        SubElement(section, "assessmentItemRef", identifier=name, href=f"{name}.xml")
    processing = SubElement(test, "outcomeProcessing")
    total = SubElement(SubElement(processing, "setOutcomeValue", identifier="SCORE"), "sum")
    SubElement(total, "testVariables", variableIdentifier="SCORE")
    return xml_bytes(test)


def manifest_xml(exercise: Exercise, names: Sequence[str]) -> bytes:
    """What the package holds, and what depends on what."""
    test = _test_name(exercise, names)
    resources = [Resource(test, "imsqti_test_xmlv2p1", TEST_FILE, names)]
    for name in names:
        sheet = f"w{name[1:]}"
        resources.append(Resource(name, "imsqti_item_xmlv2p1", f"{name}.xml", [sheet]))
        resources.append(Resource(sheet, "webcontent", f"{name}.pdf"))
    manifest = _root("manifest", CONTENT_NAMESPACE, identifier=f"m{test[1:]}")
    return manifest_of(manifest, "QTIv2.1 Package", "1.0.0", resources)


def _test_name(exercise: Exercise, names: Sequence[str]) -> str:
    return short_identifier("t", exercise.name, exercise.version, *names)


def _response(asked: AskedAnswer) -> str:
    """A name that none of QTI's own variables has."""
    return f"R-{asked.name}"


def _variable(identifier: str, cardinality: str, kind: str) -> dict[str, str]:
    return {"identifier": identifier, "cardinality": cardinality, "baseType": kind}


def _root(name: str, namespace: str, **attributes: str) -> Element:
    return root(name, namespace, SCHEMA_LOCATIONS[namespace], attributes)
