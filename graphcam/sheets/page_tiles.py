"""Pages on two sheets of paper each, for who has no larger printer."""

from graphcam.sheets.box import Box
from graphcam.sheets.model import Drawing, Entity, Group, Page, moved
from graphcam.sheets.sampling import box_of

LINE = 0.5
"""What a line may reach beyond its middle, mm."""


def in_tiles(drawing: Drawing, seam: float) -> Drawing:
    """Every page as two, left and right of the seam; a page shows what of its entities lies on it."""
    pages: list[Page] = []
    for page in drawing.pages:
        for left, right in ((0.0, seam), (seam, page.width)):
            pages.append(_tile(page, Box(left, 0.0, right, page.height)))
    return Drawing(drawing.title, tuple(pages))


def _tile(page: Page, part: Box) -> Page:
    def seen(entity: Entity) -> bool:
        """Whether any of it lies on the part."""
        box = box_of([entity])
        return box is not None and box.grown(LINE).meets(part)

    groups = [
        Group(group.name, tuple(moved(entity, -part.corner) for entity in group.entities if seen(entity)))
        for group in page.groups
    ]
    frame = Box(0.0, 0.0, part.width, part.height).grown(-page.frame.left)
    origins = {name: origin - part.corner for name, origin in page.origins.items()}
    return Page(part.width, part.height, frame, tuple(groups), origins)
