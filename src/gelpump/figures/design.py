"""Pictures of a design in millimetres and seconds, and its sheet as one page of PDF."""

import textwrap

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from gelpump.coordinates import ROUNDED
from gelpump.design import sheet
from gelpump.figures import style

LIGHT_COLOURS = {"green": "#009E73", "amber": "#E69F00", "red": "#D55E00"}
LIGHT_MARKERS = {"green": "o", "amber": "^", "red": "s"}
PAGE = (8.27, 11.69)  # inches, A4
LINE = 0.0121  # of the page


def pictures(data) -> Figure:
    """Section, front and flow of a tube; states, radius and profiles of a bead."""
    fig = style.figure(height=4.6, width=7.2)
    _draw(fig, data)
    return fig


def page(data) -> Figure:
    """The sheet: pictures, numbers, lights and what was wanted, on one page."""
    with matplotlib.rc_context({"font.family": ["STIXGeneral", "DejaVu Sans"]}):  # has subscripts
        return _page(data)


def _page(data):
    fig = style.figure(height=PAGE[1], width=PAGE[0])
    fig.set_layout_engine("none")
    fig.text(0.07, 0.962, data.attrs["design_title"], fontsize=15, va="center")
    fig.text(0.07, 0.943, sheet.subtitle(data), fontsize=7.5, color=style.GREY, va="center")
    part = fig.add_gridspec(1, 1, left=0.07, right=0.93, bottom=0.705, top=0.922)
    inner = part[0].subgridspec(2, 2, height_ratios=[1.0, 1.15], hspace=0.5, wspace=0.28)
    _draw(fig, data, inner)
    y = _rows(fig, 0.666, "Numbers", sheet.number_rows(data), (0.07, 0.46, 0.47, 0.93))
    y = _lights(fig, y - LINE, data)
    y = _wanted(fig, y - LINE, data)
    for note in sheet.notes(data):
        for line in textwrap.wrap(note, 178):
            fig.text(0.07, y, line, fontsize=6.8, va="center")
            y -= 0.78 * LINE
        y -= 0.25 * LINE
    return fig


def _heading(fig, y, text):
    fig.text(0.07, y, text, fontsize=9.5, weight="bold", va="center")
    fig.add_artist(_rule(y - 0.6 * LINE))
    return y - 1.4 * LINE


def _rule(y):
    from matplotlib.lines import Line2D

    return Line2D([0.07, 0.93], [y, y], linewidth=0.5, color=style.GREY)


def _rows(fig, y, heading, rows, columns):
    y = _heading(fig, y, heading)
    for text, value, error, source in rows:
        fig.text(columns[0], y, text, fontsize=7.5, va="center")
        fig.text(columns[1], y, value, fontsize=7.5, va="center", ha="right")
        fig.text(columns[2], y, error, fontsize=7.5, va="center", color=style.GREY)
        fig.text(columns[3], y, source, fontsize=7, va="center", ha="right", color=style.GREY)
        y -= 0.78 * LINE
    return y


def _lights(fig, y, data):
    from matplotlib.lines import Line2D

    y = _heading(fig, y, "Do the assumptions hold?")
    for row in sheet.light_rows(data):
        fig.add_artist(
            Line2D([0.078], [y], marker=LIGHT_MARKERS[row.light], markersize=6, linestyle="none",
                   color=LIGHT_COLOURS[row.light])
        )  # fmt: skip
        fig.text(0.092, y, row.light, fontsize=7.5, va="center")
        fig.text(0.135, y, row.text, fontsize=7.5, va="center")
        for line in textwrap.wrap(row.reason, 88):
            fig.text(0.4, y, line, fontsize=7.5, va="center")
            y -= 0.82 * LINE
        y -= 0.1 * LINE
    return y


def _wanted(fig, y, data):
    rows = sheet.answer_rows(data)
    if not rows:
        return y
    y = _heading(fig, y, sheet.question(data))
    for text, loose, strict in rows:
        fig.text(0.07, y, text, fontsize=7.5, va="center")
        fig.text(0.325, y, loose, fontsize=6.6, va="center")
        fig.text(0.93, y, strict, fontsize=6.5, va="center", ha="right", color=style.GREY)
        y -= 0.85 * LINE
    return y - 0.3 * LINE


def _draw(fig, data, grid=None):
    grid = fig.add_gridspec(2, 2, height_ratios=[1.0, 1.15]) if grid is None else grid
    if "unsolved" in data.attrs:
        ax = fig.add_subplot(grid[:, :])
        ax.set_axis_off()
        ax.text(0.5, 0.5, textwrap.fill(f"No picture: {data.attrs['unsolved']}.", 60),
                ha="center", va="center", color=style.GREY)  # fmt: skip
        return
    top = fig.add_subplot(grid[0, :])
    left, right = fig.add_subplot(grid[1, 0]), fig.add_subplot(grid[1, 1])
    if data.attrs["kind"] == "tube":
        _section(fig, top, data)
        _front(left, data)
        _lumen(right, data)
    else:
        _states(fig, top, data)
        _radius(left, data)
        _profiles(right, data)


def _coloured(data):
    """The polymer fraction where it is known, else its ratio; with a label."""
    name, label = "polymer_ratio", r"polymer fraction, $\phi/\phi_{00}$"
    if "polymer_fraction" in data:
        name, label = "polymer_fraction", r"polymer fraction $\phi$"
    values = data[name].values
    if np.ptp(values) <= ROUNDED * values.max():  # it stopped before anything happened
        values = np.full_like(values, values.flat[0])
    return values, label


def _section(fig, ax, data):
    half = int(np.abs(data.front_position - data.front_position[-1] / 2).values.argmin())
    values, label = _coloured(data)
    now = data.isel(t=half)
    z = 1e3 * now.z_face.values
    edges = [
        1e3 * np.interp(now.z_face, now.z, now[key]) for key in ("inner_radius", "outer_radius")
    ]
    last = 1e3 * float(data.front_position[-1])
    low, high = values.min(), values.max()
    for sign in (1, -1):
        mesh = ax.pcolormesh(
            np.stack([z, z]), sign * np.stack(edges), values[half][np.newaxis], vmin=low, vmax=high,
            cmap=style.POLYMER_FRACTION, shading="flat", rasterized=True,
        )  # fmt: skip
        if z[-1] < last:  # swollen beyond the solved part
            r = [edge[-1] for edge in edges]
            ax.pcolormesh([[z[-1], last]] * 2, sign * np.array([[r[0]] * 2, [r[1]] * 2]),
                          values[half][np.newaxis, -1:], vmin=low, vmax=high,
                          cmap=style.POLYMER_FRACTION, shading="flat")  # fmt: skip
        for edge in edges:
            ax.plot(np.append(z, max(last, z[-1])), sign * np.append(edge, edge[-1]),
                    color="#333333", linewidth=0.6)  # fmt: skip
    front = 1e3 * float(now.front_position)
    ax.axvline(front, color=style.NONLINEAR, linewidth=0.9, linestyle="--")
    seconds, unit = sheet.shown(float(now.t), "s")
    ax.set(xlim=(0, last), xlabel="$z$ (mm)", ylabel="$r$ (mm)")
    ax.set_title(
        f"section after {seconds:.3g} {unit}; dashed: $T = T_C$; radii not to scale", loc="left"
    )
    fig.colorbar(mesh, ax=ax, label=label, pad=0.02, aspect=12)


def _front(ax, data):
    t, z = data.t.values, 1e3 * data.front_position.values
    half = 5e2 * data.front_width.values
    dense = np.linspace(0, t[-1], 200)
    ax.plot(dense, z[-1] * np.sqrt(dense / t[-1]), color=style.LENS)
    ax.fill_between(t, np.maximum(z - half, 0), z + half, color=style.LENS, alpha=0.3, linewidth=0)
    ax.set(xlabel="$t$ (s)", ylabel="front $z_C$ (mm)", xlim=(0, t[-1]), ylim=(0, None))
    ax.set_title("front and its width", loc="left")


def _lumen(ax, data):
    marks = [int(np.abs(data.front_position - share * data.front_position[-1]).values.argmin())
             for share in (0.25, 0.5, 1.0)]  # fmt: skip
    last = 1e3 * float(data.front_position[-1])
    for index, colour in zip(marks, style.shades(style.LATER, len(marks)), strict=True):
        now = data.isel(t=index)
        seconds, unit = sheet.shown(float(now.t), "s")
        for form, faces, line in (
            ("conserving", "z_face_conserving", "-"),
            ("printed", "z_face", "--"),
        ):
            z, v = 1e3 * now[faces].values, 1e3 * now[f"lumen_velocity_{form}"].values
            ax.plot(np.append(z, max(1.1 * last, z[-1])), np.append(v, v[-1]), line, color=colour,
                    label=f"{seconds:.3g} {unit}" if form == "conserving" else None)  # fmt: skip
    ax.axhline(0, color=style.GREY, linewidth=0.5)
    ax.set(xlabel="$z$ (mm)", ylabel="lumen $v_z$ (mm/s)", xlim=(0, 1.1 * last))
    for line, text in (("-", "water conserved"), ("--", "as printed")):
        ax.plot([], [], line, color=style.GREY, label=text)
    _legend_above(ax)


def _states(fig, ax, data):
    values, label = _coloured(data)
    a_0 = float(data.radius[0])
    change = a_0 - data.radius.values
    angle = np.linspace(0, 2 * np.pi, 121)
    centre = 0.0
    shown = [int(np.abs(change - share * change.max()).argmin()) for share in (0.0, 0.5, 0.9, 1.0)]
    for index in sorted(set(shown)):  # one if it stopped at once
        r = 1e3 * data.r_face.values[index]
        x = centre + r[:, np.newaxis] * np.cos(angle)
        mesh = ax.pcolormesh(
            x, r[:, np.newaxis] * np.sin(angle),
            np.repeat(values[index][:, np.newaxis], 120, axis=1),
            vmin=values.min(), vmax=values.max(), cmap=style.POLYMER_FRACTION, rasterized=True,
        )  # fmt: skip
        ax.plot(x[-1], r[-1] * np.sin(angle), color="#333333", linewidth=0.6)
        when = sheet.said(float(data.t[index]), "s", 3) if index else "0 s"
        size = sheet.said(float(data.radius[index]), "m", 3)
        ax.text(centre, -1.25e3 * a_0, f"{when}\n{size}", ha="center", va="top", fontsize=8)
        centre += 5.2e3 * a_0
    ax.set(aspect="equal", xlim=(-1.2e3 * a_0, centre - 4.0e3 * a_0),
           ylim=(-2.3e3 * a_0, 1.05e3 * a_0))  # fmt: skip
    ax.set_axis_off()
    ax.set_title("sections through the bead, each with its time and radius", loc="left")
    fig.colorbar(mesh, ax=ax, label=label, pad=0.02, aspect=12)
    ax.set_anchor("W")  # the colour bar has moved it


def _radius(ax, data):
    ax.plot(data.t, 1e3 * data.radius, color=style.LENS)
    for key in ("time_50", "time_90", "response_time"):
        if key in data:
            t = float(data[key])
            here = t, 1e3 * np.interp(t, data.t, data.radius)
            name, digits = data[key].symbol.split("_")
            ax.plot(*here, "o", color=style.NONLINEAR)
            ax.annotate(
                f"${name}_{{{digits}}}$", here, (3, 4), textcoords="offset points", fontsize=8
            )
    ax.set(xlabel="$t$ (s)", ylabel="radius (mm)", xlim=(0, float(data.t[-1]) or None))
    ax.set_title("radius", loc="left")
    if data.attrs.get("stopped"):
        end = float(data.t[-1]), 1e3 * float(data.radius[-1])
        ax.plot(*end, "x", color=LIGHT_COLOURS["red"], clip_on=False, label="phases separate")
        ax.legend(loc="upper right", fontsize=7)


def _profiles(ax, data):
    values, label = _coloured(data)
    last = data.sizes["t"] - 1
    indices = np.unique(np.linspace(min(2, last), last, 6).astype(int))
    for index, colour in zip(indices, style.shades(style.LATER, len(indices)), strict=True):
        ax.plot(1e3 * data.r[index], values[index], color=colour,
                label=sheet.said(float(data.t[index]), "s", 2))  # fmt: skip
    ax.set(xlabel="$r$ (mm)", ylabel=label, xlim=(0, None))
    _legend_above(ax)


def _legend_above(ax):
    """In one line above the axes, where it hides nothing."""
    ax.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 0.98), ncols=6, fontsize=7, handlelength=1.1,
        handletextpad=0.4, columnspacing=0.8, borderpad=0.2,
    )  # fmt: skip
