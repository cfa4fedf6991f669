"""A package of quizzes for Canvas: one a variant, each with the task, the worksheet and a question for every number.

Canvas takes tolerances from numerical questions of QTI 1.2 only, in the form in which it writes them itself.  Of items
of QTI 2.1 its Classic Quizzes compare the text of an answer, and its New Quizzes refuse those with several blanks.
"""

from collections.abc import Sequence
from html import escape
from pathlib import Path
from xml.etree.ElementTree import Element, SubElement

from graphcam.exercises.course.handouts import instructions
from graphcam.exercises.course.roster import folder_name
from graphcam.exercises.definition.exercise import AskedAnswer, Exercise
from graphcam.exercises.exports.content_package import MANIFEST_FILE, Resource, manifest_of, root, write_zip, xml_bytes
from graphcam.exercises.exports.question_parts import (
    PRINT_ADVICE,
    SEPARATE_HAND_IN,
    IssuedVariant,
    check_numbers,
    question_body,
    short_identifier,
    variant_identifier,
    worksheet_pdf,
)

QTI_NAMESPACE = ("http://www.imsglobal.org/xsd/ims_qtiasiv1p2", "http://www.imsglobal.org/xsd/ims_qtiasiv1p2p1.xsd")
CONTENT_NAMESPACE = ("http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1", "http://www.imsglobal.org/xsd/imscp_v1p1.xsd")
CANVAS_NAMESPACE = ("http://canvas.instructure.com/xsd/cccv1p0", "https://canvas.instructure.com/xsd/cccv1p0.xsd")
"""Namespaces, and where their schemas are."""
FILES_FOLDER = "%24IMS-CC-FILEBASE%24"
"""The placeholder of the folder into which Canvas puts the files of a package."""
RESPONSE_ID = "response1"


def write_quizzes(path: Path, exercise: Exercise, issued: Sequence[IssuedVariant]) -> None:
    """Write the package, a zip, of several variants.

    Raises
    ------
    TaskError : no answer of the exercise is a number
    """
    check_numbers(exercise)
    resources: list[Resource] = []
    files: dict[str, bytes] = {}
    for each in issued:
        name = variant_identifier(each)
        quiz, settings, sheet = f"{name}/{name}.xml", f"{name}/assessment_meta.xml", f"worksheets/{name}.pdf"
        learning = "associatedcontent/imscc_xmlv1p1/learning-application-resource"
        resources += [
            Resource(name, "imsqti_xmlv1p2", quiz, [f"s{name[1:]}"]),
            Resource(f"s{name[1:]}", learning, settings),
            Resource(f"w{name[1:]}", "webcontent", sheet),
        ]
        files |= {quiz: quiz_xml(exercise, each), settings: settings_xml(exercise, each), sheet: worksheet_pdf(each)}
    identifier = short_identifier("m", exercise.name, exercise.version, *(each.identifier for each in resources))
    manifest = root("manifest", *CONTENT_NAMESPACE, {"identifier": identifier})
    write_zip(path, {MANIFEST_FILE: manifest_of(manifest, "IMS Content", "1.1.3", resources)} | files)


def quiz_xml(exercise: Exercise, issued: IssuedVariant) -> bytes:
    """The quiz of one variant: a text with the task and the worksheet, then a question for every number."""
    name, tell = variant_identifier(issued), exercise.tell
    document = root("questestinterop", *QTI_NAMESPACE, {})
    assessment = SubElement(document, "assessment", ident=name, title=_title(exercise, issued))
    section = SubElement(assessment, "section", ident="root_section")
    link = f'<a href="{FILES_FOLDER}/worksheets/{name}.pdf">{escape(tell(PRINT_ADVICE))}</a>'
    lines = [escape(instructions(issued.variant)), link]
    lines += [
        escape(f"{question_body(exercise, issued.answer_key, asked)} {tell(SEPARATE_HAND_IN)}")
        for asked in exercise.answers
        if asked.kind != "number"
    ]
    _item(section, short_identifier("q", name), exercise.title, "text_only_question", 0.0, lines)
    for asked in exercise.answers:
        if asked.kind == "number":
            _add_question(section, exercise, issued, asked)
    return xml_bytes(document)


def settings_xml(exercise: Exercise, issued: IssuedVariant) -> bytes:
    """What Canvas is to do with the quiz: it counts, and nobody sees the key."""
    settings = root("quiz", *CANVAS_NAMESPACE, {"identifier": variant_identifier(issued)})
    points = sum(asked.marks for asked in exercise.answers if asked.kind == "number")
    said = {
        "title": _title(exercise, issued),
        "quiz_type": "assignment",
        "points_possible": repr(points),
        "show_correct_answers": "false",
        "allowed_attempts": "1",
    }
    for name, value in said.items():
        SubElement(settings, name).text = value
    return xml_bytes(settings)


def _add_question(section: Element, exercise: Exercise, issued: IssuedVariant, asked: AskedAnswer) -> None:
    """A numerical question: the key, or any number within its tolerance, has all marks."""
    identifier = short_identifier("q", variant_identifier(issued), asked.name)
    text = escape(question_body(exercise, issued.answer_key, asked))
    item, presentation = _item(section, identifier, asked.name, "numerical_question", asked.marks, [text])
    response = SubElement(presentation, "response_str", ident=RESPONSE_ID, rcardinality="Single")
    SubElement(SubElement(response, "render_fib", fibtype="Decimal"), "response_label", ident="answer1")
    processing = SubElement(item, "resprocessing")
    most = {"maxvalue": "100", "minvalue": "0", "varname": "SCORE", "vartype": "Decimal"}
    SubElement(SubElement(processing, "outcomes"), "decvar", most)
    condition = SubElement(processing, "respcondition", {"continue": "No"})
    either = SubElement(SubElement(condition, "conditionvar"), "or")
    key = issued.answer_key.keys[asked.name]
    value = float(str(key.expected.value))
    SubElement(either, "varequal", respident=RESPONSE_ID).text = repr(value)
    within = SubElement(either, "and")
    SubElement(within, "vargte", respident=RESPONSE_ID).text = repr(value - key.tolerance)
    SubElement(within, "varlte", respident=RESPONSE_ID).text = repr(value + key.tolerance)
    SubElement(condition, "setvar", action="Set", varname="SCORE").text = "100"


def _item(
    section: Element, identifier: str, title: str, kind: str, points: float, lines: Sequence[str]
) -> tuple[Element, Element]:
    """A new item with its text, lines of HTML; the item, and its presentation, which a field may follow."""
    item = SubElement(section, "item", ident=identifier, title=title)
    metadata = SubElement(SubElement(item, "itemmetadata"), "qtimetadata")
    for label, entry in (("question_type", kind), ("points_possible", repr(points))):
        field = SubElement(metadata, "qtimetadatafield")
        SubElement(field, "fieldlabel").text = label
        SubElement(field, "fieldentry").text = entry
    presentation = SubElement(item, "presentation")
    html = "".join(f"<p>{line}</p>" for line in lines)
    SubElement(SubElement(presentation, "material"), "mattext", texttype="text/html").text = html
    return item, presentation


def _title(exercise: Exercise, issued: IssuedVariant) -> str:
    return f"{exercise.title}: {folder_name(issued.student.id)}"
