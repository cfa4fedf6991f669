"""Sheets: page formats and frames, layout, labels, and the renderers for PDF, SVG, PNG and DXF.

Knows marks and paper, no cams.  In order of use:

- :func:`graphcam.sheets.layout.compose` makes a :class:`~graphcam.sheets.model.Drawing` of steps and tables; how large
  a profile may be is told beforehand by :func:`graphcam.sheets.layout.profile_room`;
- :mod:`graphcam.sheets.matplotlib_renderer` writes PDF, SVG and PNG, :mod:`graphcam.sheets.dxf_renderer` DXF.

The renderers load matplotlib and ezdxf, so they are imported where something is rendered, not before.
"""
