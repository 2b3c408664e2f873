"""The catalogue against the tables of the language."""

import pytest
from frot.dsl.catalogue import FORCES, LAWS, LIAISONS, SHAPES, find, spellings

TABLES = {"shapes": SHAPES, "liaisons": LIAISONS, "laws": LAWS, "forces": FORCES}


@pytest.mark.parametrize("name", TABLES)
def test_entries_are_documented_and_their_names_are_different(name: str) -> None:
    entries = TABLES[name]
    names = spellings(entries)
    assert len(set(names)) == len(names)
    for key, entry in entries.items():
        assert key == entry.name
        assert entry.doc.endswith(".")
        assert all(a.doc for a in entry.arguments)
        # What may be left out comes after what may not, or positions would be ambiguous.
        required = [a.required for a in entry.arguments]
        assert required == sorted(required, reverse=True)


@pytest.mark.parametrize(
    ("aliases", "relations"),
    [
        ("encastrement weld", 6),
        ("rotoide rotoïde pivot revolute", 5),
        ("prismatique glissiere glissière prismatic", 5),
        ("verrou pivot_glissant cylindrical", 4),
        ("helicoidale hélicoïdale screw", 5),
        ("cardan universal", 4),
        ("spherique sphérique rotule spherical", 3),
        ("appui_plan planar", 3),
        ("lineaire_annulaire point_on_line", 2),
        ("lineaire_rectiligne line_on_plane", 2),
        ("tige link", 1),
        ("fil thread", 1),
        ("point_courbe point_on_curve", 2),
        ("point_surface point_on_surface", 1),
        ("contact_ponctuel point_contact", 1),
        ("courbe_courbe curves_tangent", 3),
        ("roulement rolling", 3),
        ("libre free", 0),
    ],
)
def test_liaisons_by_any_name(aliases: str, relations: int) -> None:
    (kind,) = {id(k): k for k in (find(LIAISONS, a) for a in aliases.split())}.values()
    assert kind is not None and kind.relations_space == relations


def test_freedoms_of_a_free_body() -> None:
    """Painlevé counts 3 l + 5 m + 6 n: points, slender rods, solids."""
    assert SHAPES["particle"].freedoms_space == 3
    assert SHAPES["rod"].freedoms_space == 5
    assert {s.freedoms_space for n, s in SHAPES.items() if n not in ("particle", "rod")} == {6}
    assert {n: s.freedoms_planar for n, s in SHAPES.items() if s.planar}["particle"] == 2


@pytest.mark.parametrize("name", LIAISONS)
def test_slips_are_coordinates_of_joints_with_friction(name: str) -> None:
    kind = LIAISONS[name]
    for names in kind.slips:
        assert set(names) <= {*kind.coordinates, "displacement", "u", "x", "y"}
    assert bool(kind.slips) <= ("coulomb" in (*kind.laws, *kind.laws_in_space))
    assert not (kind.pin or kind.guide) or kind.slips
    assert not (kind.pin and kind.guide)
    assert set(kind.own_laws) <= {"plane", "space"}
