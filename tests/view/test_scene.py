"""A scene shows bodies, places and reactions where the run has them."""

from __future__ import annotations

import numpy as np
import pytest
from view_scenes import result_of, scene_at

import frot
from frot.view.scene import turn

TURNED = """
planar model Turned
  body stick: rod(mass = 1 kg, length = 2 m);
  body weight: solid(mass = 3 kg, inertia = 1 kg.m^2, com = (0.5, 0) m);
  frame mark on weight at (1, 1) m rotated(angle = 30 deg);
  liaison pin: rotoide(ground, stick.start);
  liaison elbow: rotoide(stick.tip, weight.origin);
initial
  pin.angle = 90 deg;
  elbow.angle = -90 deg;
  experiment(stop = 0.1 s);
end Turned;
"""


def test_bodies_stand_where_the_run_has_them() -> None:
    result = result_of("backspin_hoop")
    times = [0.0, 1.0, 2.5]
    scene = scene_at(result, times)
    values = result.at(np.array(times))
    pose = scene.poses["hoop"]
    assert pose[:, 0] == pytest.approx(values["hoop.position.x"], abs=1e-12)
    assert pose[:, 1] == pytest.approx(values["hoop.position.y"], abs=1e-12)
    for k, angle in enumerate(values["hoop.angle"]):
        axis = turn(pose[k, 3:])[:2, 0]
        assert axis == pytest.approx((np.cos(angle), np.sin(angle)), abs=1e-12)


def test_a_frame_stands_on_its_body_from_the_origin() -> None:
    """The stick points upwards, so its tip is at (0, 2); the weight lies along x from there."""
    result = frot.compile(TURNED).simulate()
    scene = scene_at(result, [0.0])
    assert scene.poses["weight"][0, :3] == pytest.approx((0.5, 2, 0), abs=1e-9)
    assert scene.poses["mark"][0, :3] == pytest.approx((1, 3, 0), abs=1e-9)
    assert turn(scene.poses["mark"][0, 3:])[:2, 0] == pytest.approx(
        (np.cos(np.pi / 6), 0.5), abs=1e-9
    )


def test_a_body_without_a_figure_is_joined_to_what_is_fixed_to_it() -> None:
    """From G the mark is at (0.5, 1), the origin at (-0.5, 0): a bar ends at each."""
    scene = scene_at(frot.compile(TURNED).simulate(), [0.0])
    (weight,) = (p for p in scene.parts if p.name == "weight" and p.kind == "body")
    points = weight.shapes[0].points
    for end in ((0.5, 1, 0), (-0.5, 0, 0)):
        assert np.linalg.norm(points - np.array(end), axis=1).min() < 0.5 * scene.small


def test_reactions_act_where_a_hoop_touches_and_balance_its_weight() -> None:
    """On a level floor N = m g upwards; the friction of a hoop with backspin is -mu m g."""
    scene = scene_at(result_of("backspin_hoop"), [0.5])
    (floor,) = scene.touching
    assert floor.places[0, 1] == pytest.approx(0, abs=1e-12)
    assert floor.places[0, 0] == pytest.approx(scene.poses["hoop"][0, 0], abs=1e-12)
    assert floor.normal[0] == pytest.approx((0, 9.81, 0), abs=1e-9)
    assert floor.along[0] == pytest.approx((-0.3 * 9.81, 0, 0), abs=1e-9)
    assert np.tan(floor.cone) == pytest.approx(0.3)
    assert floor.modes is not None and floor.modes[0] == 2  # slip


def test_the_force_is_shown_on_the_body_that_moves() -> None:
    """The same contact, its places in the other order: the arrow still points upwards."""
    text = """
planar model Other
  body ball: disc(mass = 2 kg, radius = 0.1 m);
  liaison floor: contact_ponctuel(ball.rim, ground.line) with coulomb(0.5);
initial
  ball.position = (0, 0.1) m;
  ball.velocity.x = 1 m/s;
  experiment(stop = 0.1 s);
end Other;
"""
    (floor,) = scene_at(frot.compile(text).simulate(), [0.05]).touching
    assert floor.normal[0] == pytest.approx((0, 2 * 9.81, 0), abs=1e-9)


def test_a_curve_that_time_changes_is_drawn_as_it_is_then() -> None:
    """The circle of the model grows as K t: its radius doubles as the time does."""
    result = result_of("expanding_circle")
    first = float(result.time[0])
    last = float(result.time[-1])
    scene = scene_at(result, [first, last])
    (circle,) = (p for p in scene.parts if p.kind == "curve")
    sizes = [np.linalg.norm(x.lines[0], axis=1).max() for x in circle.shapes]
    assert len(sizes) == 2
    assert sizes[1] / sizes[0] == pytest.approx(last / first, rel=1e-9)


def test_threads_and_springs_join_their_points() -> None:
    result = result_of("andrews_squeezer")
    scene = scene_at(result, [0.0, 0.01])
    (spring,) = (x for x in scene.joinings if x.kind == "spring")
    # E. Hairer, G. Wanner: the fixed end of the spring is C = (0.014, 0.072)
    assert spring.ends[:, 0, :2] == pytest.approx(np.tile((0.014, 0.072), (2, 1)), abs=1e-9)


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_symbols_have_the_scale_of_the_mechanism(scale: float) -> None:
    text = f"""
planar model Pendulum
  body stick: rod(mass = 1 kg, length = {scale} m);
  liaison pin: rotoide(ground, stick.start);
initial
  pin.angle = 0;
  experiment(stop = 0.001 s);
end Pendulum;
"""
    scene = scene_at(frot.compile(text).simulate(), [0.0])
    assert scene.small / scale == pytest.approx(0.05, abs=0.03)


def test_what_rolls_far_is_followed() -> None:
    assert scene_at(result_of("backspin_hoop"), [0.0, 1.5, 3.0]).follow
    assert not scene_at(result_of("slider_crank", stop=0.5), [0.0, 0.25, 0.5]).follow


def test_between_two_moments_of_a_page_nothing_leaves_its_path() -> None:
    """The tip of the crank is on a circle; places go straight from one moment to the next."""
    from frot.view.moments import times_of

    result = result_of("slider_crank")
    scene = scene_at(result, list(times_of(result)))
    tips = scene.poses["crank.tip"][:, :2]
    radius = np.linalg.norm(tips[0])
    assert np.linalg.norm(tips, axis=1) == pytest.approx(radius, rel=1e-6)
    middles = (tips[:-1] + tips[1:]) / 2
    assert np.linalg.norm(middles, axis=1).min() > 0.99 * radius
