"""What each figure is called, and what it looks like to who cannot see it.

Alternative texts tell the kind of picture and what varies in it; numbers are in the captions.
"""

from typing import NamedTuple


class Drawing(NamedTuple):
    """A figure's title and its alternative text."""

    title: str
    alt: str


DRAWINGS = {
    "fig01_lens_schematic": Drawing(
        "How LENS splits a deformation",
        "Three drawings. A disc of evenly spaced rings and wedges; the same disc smaller, its "
        "outer rings drawn together, inside a dotted outline of the first; and two of its "
        "elements, each with its reference, isotropic and true outline.",
    ),
    "fig02_osmotic_schema": Drawing(
        "Osmotic pressure on either side of the transition",
        "Two curves of osmotic pressure over polymer fraction, a colder and a hotter one, with "
        "dots where they cross zero. The hotter crosses at a larger polymer fraction; the area "
        "of negative pressure before it is shaded.",
    ),
    "fig03_swell_bead": Drawing(
        "A bead swells",
        "Left: a map of polymer fraction over logarithmic time and radius, with rising curves "
        "of the bead's radius from two models that nearly coincide. Right: radial profiles of "
        "polymer fraction, from high and flat to low and flat, whose steep part moves inwards.",
    ),
    "fig04_dry_bead": Drawing(
        "A bead dries",
        "Left: a map of polymer fraction over time and radius, with falling curves of the "
        "bead's radius from two models. Right: radial profiles of polymer fraction, which rise "
        "from the surface inwards and stay low at the centre.",
    ),
    "fig05_spinodal": Drawing(
        "Beads in the plane of temperature and polymer fraction",
        "A grey region of negative diffusivity beside an S-shaped equilibrium curve. Paths of "
        "beads jump sideways in temperature, then run up or down; one ends with a cross at the "
        "grey region. An inset enlarges the fold.",
    ),
    "fig06_tube_schematic": Drawing(
        "A tube, partly collapsed",
        "A hollow tube cut open along its axis: narrow and dark on the left, where it is hot, "
        "wide and pale on the right, with a smooth step at the front. Inner and outer radii are "
        "marked on either side.",
    ),
    "fig07_deswelling": Drawing(
        "How fast a tube that is heated everywhere deswells",
        "Left: a map of the deswelling time over shear parameter and osmotic pressure ratio, "
        "slow in the lower left corner. Right: polymer fraction over time, one rising curve for "
        "each wall thickness, thin walls fastest.",
    ),
    "fig08_profiles": Drawing(
        "A pulse of heat travels along a tube",
        "Two sections of a tube coloured by polymer fraction, one below the other; the step "
        "between the collapsed and the swollen part is further right in the later one.",
    ),
    "fig09_relax": Drawing(
        "The drying front and its sharpness",
        "Left: polymer fraction across the front, steeper for thinner walls, with the tanh "
        "curves that fit best and an inset around the front. Right: fitted sharpness over one "
        "minus ell on logarithmic axes, dots on a straight falling line, published circles "
        "above it for thin walls.",
    ),
    "fig10_flow": Drawing(
        "Flow around the drying front",
        "Two sections of a tube's wall coloured by polymer fraction, with arrows: out of the "
        "wall behind the front, into it ahead of the front, and along the lumen.",
    ),
    "fig11_flow_close": Drawing(
        "Interstitial flow close to the front",
        "Two enlarged sections of the wall at the front, a thick and a thin one, with arrows of "
        "the flow in the gel, outwards behind and inwards ahead of the front.",
    ),
    "fig12_axial_flow": Drawing(
        "The pulse of water in the lumen",
        "Top: axial velocity along the tube at several times, each a peak with a lower plateau "
        "ahead of it. Below: its maximum over the sharpness, a falling line on logarithmic "
        "axes, and over one minus ell, falling as well.",
    ),
    "fig13_osmotic": Drawing(
        "Osmotic pressure of the two gels",
        "Two panels of osmotic pressure over polymer fraction, a family of curves from cold, "
        "blue, to hot, red, each with a dot at its equilibrium and an inset around the swollen "
        "ones.",
    ),
    "fig14_equilibrium": Drawing(
        "Equilibrium polymer fraction",
        "Two panels of equilibrium polymer fraction over temperature. Each curve is S-shaped "
        "with two folds, wide apart in the first gel and close together, enlarged by an inset, "
        "in the second.",
    ),
    "figX1_conservation": Drawing(
        "Whether the wall conserves water",
        "Top left: what the wall has lost and what has gone through its edges over time, one pair "
        "of curves for each closure; the printed pair parts, the others coincide. Top right: the "
        "difference, near one for the printed closure, at rounding for the others. Below: polymer "
        "fraction across the front by each closure, three falling curves.",
    ),
    "figX2_wall": Drawing(
        "How fast a wall resolved in r deswells",
        "Three panels of the deswelling time over the shear parameter, over ell and over the "
        "contrast of polymer fractions. Lines of the slender closures, and dots of the resolved "
        "wall: with no force on the surface the time hardly depends on the shear parameter.",
    ),
    "figX4_pump_balance": Drawing(
        "Where the water of the pump goes",
        "Top left: stacked areas over ell, the lumen's collapse, the wall's water into the lumen "
        "and into the bath, with dots on their edges. Top right: velocity far ahead over time, "
        "two closures tending to a dotted line that the printed one crosses. Below: pumped "
        "volumes over the contrast of polymer fractions and over the shear parameter, dots on "
        "grey lines.",
    ),
    "figX5_front": Drawing(
        "A bead that separates, to the end",
        "Left: falling curves of the bead's and of the front's radius over time in two models; "
        "one front sets out at once, the other later, from crosses. Right: profiles of polymer "
        "fraction with one vertical step each, dry outside and swollen inside, moving inwards.",
    ),
    "figX6_coexistence": Drawing(
        "Phases that meet at a front",
        "Left: a grey region of negative diffusivity in the plane of temperature and polymer "
        "fraction between pairs of curves, nearly one for the dry side and several for the "
        "swollen. Right: radius over the temperature at which separation begins, two rising "
        "curves, a third far right of them where the core itself is unstable, and a falling dashed "
        "one of the critical hoop stretch.",
    ),
    "figX8_heat": Drawing(
        "How far the heat of a collapse holds the front back",
        "Top left: the front over the diffusion length against time, each curve tending to a dot; "
        "the bath's is flat and highest, the insulated tubes' lowest. Top right: falling profiles "
        "of temperature with a kink where they cross zero. Bottom left: shift of the front over "
        "the latent heat, rising lines for pipe and bath, a nearly flat one for insulation. Bottom "
        "right: position of the front over time on logarithmic axes, twice as steep by the printed "
        "heat equation.",
    ),
    "figX9_cycle": Drawing(
        "Heated and cooled, again and again",
        "Top left: loops of a bead's radius over temperature, thin and slow, wide and fast, one "
        "of a gel that jumps at two temperatures, about grey equilibrium curves. Top right: the "
        "programme and the radius over time. Below left: water past a station over two cycles, "
        "rising while the end is hot and back to zero after, with dots of a second solver. Below "
        "right: what a cycle moves and what it leaves, over the period on logarithmic axes.",
    ),
    "verification": Drawing(
        "Errors of the solvers on known solutions",
        "Errors over the number of cells and of time steps on logarithmic axes, falling along "
        "dashed lines of the formal orders.",
    ),
}
