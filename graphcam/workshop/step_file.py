"""A file of ISO 10303-21 (STEP) by the application protocol 214: entities with numbers, header, product, units.

The bytes repeat: the file bears no date.  Sources: ISO 10303-21:2016 (the text), ISO 10303-214:2010 (the schema
``automotive_design``), ISO 10303-42 (geometry and topology).
"""

from collections.abc import Iterable, Sequence

UNCERTAINTY = 1e-5
"""What two points may be apart and still be one [mm]."""


class StepFile:
    """Entities in the order in which they are added; each is known by what :meth:`add` returns."""

    def __init__(self) -> None:
        self._lines: list[str] = []

    def add(self, name: str, *values: object) -> str:
        """An entity of that name with these values, as :func:`written` writes them; returns its reference."""
        return self.add_text(f"{name}({','.join(map(written, values))})")

    def add_text(self, text: str) -> str:
        """An entity written out."""
        self._lines.append(text)
        return f"#{len(self._lines)}"

    def point(self, *xyz: float) -> str:
        """A point [mm]."""
        return self.add("CARTESIAN_POINT", "''", xyz)

    def direction(self, *xyz: float) -> str:
        """A unit vector."""
        return self.add("DIRECTION", "''", xyz)

    def axes(self, origin: tuple[float, ...], axis: tuple[float, ...], across: tuple[float, ...]) -> str:
        """A system of axes: its origin, its third and its first one."""
        places = self.point(*origin), self.direction(*axis), self.direction(*across)
        return self.add("AXIS2_PLACEMENT_3D", "''", *places)

    def finish(self, solid: str, name: str, description: str, program: str) -> str:
        """The whole file, with a solid as the shape of a product."""
        self._product(solid, text(name))
        entities = (f"#{k}={line};" for k, line in enumerate(self._lines, 1))
        head = (
            "ISO-10303-21;",
            "HEADER;",
            f"FILE_DESCRIPTION(({text(description)}),'2;1');",
            f"FILE_NAME('profile.step','1970-01-01T00:00:00',(''),(''),{text(program)},'graphcam','');",
            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));",
            "ENDSEC;",
            "DATA;",
        )
        return "".join(f"{line}\n" for line in (*head, *entities, "ENDSEC;", "END-ISO-10303-21;"))

    def _product(self, solid: str, name: str) -> None:
        application = self.add("APPLICATION_CONTEXT", "'automotive design'")
        self.add(
            "APPLICATION_PROTOCOL_DEFINITION", "'international standard'", "'automotive_design'", 2000, application
        )
        context = self.add("PRODUCT_CONTEXT", "''", application, "'mechanical'")
        product = self.add("PRODUCT", name, name, "''", [context])
        self.add("PRODUCT_RELATED_PRODUCT_CATEGORY", "'part'", "$", [product])
        formation = self.add("PRODUCT_DEFINITION_FORMATION", "''", "''", product)
        of = self.add("PRODUCT_DEFINITION_CONTEXT", "'part definition'", application, "'design'")
        definition = self.add("PRODUCT_DEFINITION", "'design'", "''", formation, of)
        shape = self.add("PRODUCT_DEFINITION_SHAPE", "''", "''", definition)
        where = self.axes((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
        is_shape = self.add("ADVANCED_BREP_SHAPE_REPRESENTATION", name, [where, solid], self._units())
        self.add("SHAPE_DEFINITION_REPRESENTATION", shape, is_shape)

    def _units(self) -> str:
        """Millimetres and radians."""
        length = self.add_text("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))")
        angle = self.add_text("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))")
        solid_angle = self.add_text("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())")
        within = self.add_text(
            f"UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE({real(UNCERTAINTY)}),{length},'distance_accuracy_value','')"
        )
        return self.add_text(
            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)"
            f"GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT(({within}))"
            f"GLOBAL_UNIT_ASSIGNED_CONTEXT(({length},{angle},{solid_angle}))"
            "REPRESENTATION_CONTEXT('',''))"
        )


def written(value: object) -> str:
    """A value of an entity: references, texts and what is written out stay, the rest follows the standard.

    >>> written([1.0, 2.5e-7]), written(True), written(3), written("#7")
    ('(1.,2.5E-07)', '.T.', '3', '#7')
    """
    if isinstance(value, str):
        return value
    if isinstance(value, bool):
        return ".T." if value else ".F."
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        return real(value)
    assert isinstance(value, Iterable)
    items: Sequence[object] = list(value)
    return f"({','.join(map(written, items))})"


def real(value: float) -> str:
    """A real number, which always has a point.

    >>> real(-0.0), real(1e-5), real(1 / 3)
    ('0.', '1.E-05', '0.333333333333333')
    """
    digits, exponent, power = f"{value + 0.0:.15G}".partition("E")
    return digits + ("" if "." in digits else ".") + exponent + power


def text(said: str) -> str:
    r"""A text in ASCII, other letters by their numbers.

    >>> print(text("cam's"), text("Кулачок №1"))
    'cam''s' '\X2\041A0443043B04300447043E043A\X0\ \X2\2116\X0\1'
    """
    out, other = "", ""
    for c in f"{said}\0":
        if c.isascii():
            if other:
                out += rf"\X2\{other.encode('utf-16-be').hex().upper()}\X0" + "\\"
                other = ""
            out += {"'": "''", "\\": "\\\\", "\0": ""}.get(c, c if c.isprintable() else " ")
        else:
            other += c
    return f"'{out}'"
