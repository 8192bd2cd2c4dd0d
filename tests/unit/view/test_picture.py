"""The composed picture."""

import subprocess
import sys
from io import BytesIO

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from scipy.spatial.transform import Rotation

from rheoclast import Aggregate, LinearFlow, Spheres, simple_shear, uniaxial_extension
from rheoclast.view import draw, save
from rheoclast.view.colours import ColourScale

RADIUS = 5e-7


def touching(centers):
    return Aggregate.touching(Spheres(RADIUS * np.asarray(centers, dtype=float), RADIUS))


def grown(count, recent=30, seed=1):
    """Random tree of touching spheres, each added to one of the most recent: the fewer, the more open."""
    rng = np.random.default_rng(seed)
    centers = np.zeros((1, 3))
    while len(centers) < count:
        step = rng.normal(size=3)
        new = centers[rng.integers(max(0, len(centers) - recent), len(centers))] + 2 * step / np.linalg.norm(step)
        if np.linalg.norm(centers - new, axis=1).min() > 2 - 1e-9:
            centers = np.vstack([centers, new])
    return touching(centers)


BENT = touching([[0, 0, 0], [2, 0, 0], [4, 0, 0], [6, 0, 0], [6, 2, 0], [6, 2, 2]])
BENT_VALUES = 1e-9 * np.array([1.0, -2, 3, -1, 0.5])


def pixels(figure):
    """(H, W, 3) from 0 to 1, row 0 at the top."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3] / 255


def texts(figure):
    return [text.get_text() for text in figure.findobj(lambda artist: hasattr(artist, "get_text"))]


def spheres_part(figure):
    image = pixels(figure)
    return image[: round(image.shape[0] * (1 - figure.axes[0].get_position().y0))]


def test_picture_is_not_blank_and_its_border_is_white():
    image = pixels(draw(BENT, BENT_VALUES, flow=simple_shear(1.0), critical=2, title="Bent"))
    assert (image < 0.95).any(axis=2).mean() > 0.1
    assert all((edge == 1).all() for edge in (image[0], image[-1], image[:, 0], image[:, -1]))


@pytest.mark.parametrize("dots_per_inch", [74.18677918682775, 80, 100, 160, 173.3])
def test_image_is_shown_pixel_for_pixel(dots_per_inch):
    figure = draw(BENT, title="Bent", dots_per_inch=dots_per_inch)
    shown = spheres_part(figure)
    shown = shown[-figure.axes[0].images[0].get_array().shape[0] :]
    image = np.asarray(figure.axes[0].images[0].get_array())[::-1]
    assert image.shape[:2] == shown.shape[:2]
    expected = image[..., :3] * image[..., 3:] + 1 - image[..., 3:]
    assert np.abs(shown - expected).max() < 0.02


@pytest.mark.parametrize(("value", "sign"), [(1e-9, 1), (-1e-9, -1)])
def test_tension_is_red_and_compression_blue(value, sign):
    image = spheres_part(draw(touching([[0, 0, 0], [2, 0, 0]]), [value]))
    colour = image[..., 0] - image[..., 2]
    assert sign * colour.sum() > 1000
    assert (sign * colour).max() > 0.4


@pytest.mark.parametrize("sign", [1, -1])
def test_loads_of_spheres_of_a_pixel_are_seen(sign):
    chain = touching([[2 * k, 0, 0] for k in range(300)])
    image = spheres_part(draw(chain, np.full(299, sign * 1e-9), size=(4.5, 2.5), dots_per_inch=100))
    covered = (image < 0.9).any(axis=2)
    assert (sign * (image[..., 0] - image[..., 2]))[covered].mean() > 0.2


def test_without_values_the_spheres_are_grey():
    image = pixels(draw(BENT))
    assert np.ptp(image, axis=2).max() < 0.1
    assert (image < 0.95).any()


def test_larger_loads_are_more_vivid():
    scale = ColourScale(np.array([1.0]))
    vividness = np.ptp(scale(np.array([0.0, 0.25, 0.5])), axis=1)
    assert (np.diff(vividness) > 0.1).all()
    assert vividness[0] < 0.05


@pytest.mark.parametrize(
    ("values", "extend"), [([-3.0, 1], "neither"), ([*np.linspace(-1, 1, 99), 9], "max"), ([0, 0], "neither")]
)
def test_colour_scale_is_symmetric(values, extend):
    scale = ColourScale(np.array(values))
    assert scale.norm.vmin == -scale.norm.vmax
    assert scale(np.array([0.0]))[0] == pytest.approx([0.89, 0.89, 0.89], abs=0.01)
    assert scale.extend == extend


@pytest.mark.parametrize("seed", range(3))
def test_picture_does_not_change_when_aggregate_and_view_turn_together(seed):
    rotation = Rotation.random(rng=np.random.default_rng(seed))
    turned = touching(rotation.apply(BENT.spheres.centers.copy()) / RADIUS + [0, 0, 40])
    before, after = (spheres_part(draw(body, BENT_VALUES)) for body in (BENT, turned))
    assert before.shape == after.shape
    assert np.abs(before - after).mean() < 1e-3


def test_picture_does_not_change_when_aggregate_and_given_view_turn_about_z():
    rotation = Rotation.from_rotvec([0, 0, 0.7])
    turned = touching(rotation.apply(BENT.spheres.centers.copy()) / RADIUS)
    direction = np.array([1.0, -2, 0.5])
    before = spheres_part(draw(BENT, BENT_VALUES, view_direction=direction))
    after = spheres_part(draw(turned, BENT_VALUES, view_direction=rotation.apply(direction)))
    assert before.shape == after.shape
    assert np.abs(before - after).mean() < 1e-3


def test_picture_of_300_spheres_in_an_open_cluster_is_a_small_file(tmp_path):
    aggregate = grown(300, recent=1)
    values = 1e-9 * np.random.default_rng(0).normal(size=len(aggregate.pairs))
    path = tmp_path / "cluster.png"
    save(draw(aggregate, values, flow=uniaxial_extension(10), critical=5), path)
    assert 20_000 < path.stat().st_size < 300_000


def test_picture_is_written_to_open_files_and_as_pdf(tmp_path):
    figure = draw(BENT, BENT_VALUES)
    stream = BytesIO()
    save(figure, stream)
    assert stream.getvalue().startswith(b"\x89PNG")
    save(figure, tmp_path / "bent.pdf")
    assert (tmp_path / "bent.pdf").read_bytes().startswith(b"%PDF")


def test_labels_have_prefixed_units():
    shown = texts(draw(BENT, BENT_VALUES, critical=2))
    assert "tension (nN)" in shown
    assert "critical contact: 3 nN" in shown
    assert "500 nm" in shown


def test_dimensionless_labels_have_no_units():
    aggregate = Aggregate.touching(Spheres(np.array([[0.0, 0, 0], [2, 0, 0]]), 1.0))
    shown = texts(draw(aggregate, [0.5], quantity="tension / μGa²", unit=None, length_unit=None, critical=0))
    assert {"tension / μGa²", "critical contact: 0.5", "1"} <= set(shown)


def test_scale_bar_is_as_long_as_it_says():
    figure = draw(BENT, view_direction=(0, 0, 1))
    bar = next(axes for axes in figure.axes if "500 nm" in [text.get_text() for text in axes.texts])
    (line,) = bar.lines
    left, right = bar.transData.transform(np.column_stack([line.get_xdata(), [0, 0]]))[:, 0]
    covered = np.flatnonzero((spheres_part(figure) < 0.98).any(axis=(0, 2)))
    assert right - left == pytest.approx(np.ptp(covered) / 8, rel=0.02)


@pytest.mark.parametrize("critical", [0, 4])
@pytest.mark.parametrize("size", [(4.5, 2.5), (6.4, 5.6)])
@pytest.mark.parametrize("body", ["bent", "cluster"])
def test_no_text_is_cut_off(critical, size, body):
    aggregate = BENT if body == "bent" else grown(60)
    values = 1e-9 * np.cos(np.arange(len(aggregate.pairs)))
    figure = draw(
        aggregate, values, flow=simple_shear(1.0), critical=critical, size=size, title="Title", dots_per_inch=80
    )
    width, height = FigureCanvasAgg(figure).get_width_height()
    for text in figure.findobj(lambda artist: hasattr(artist, "get_window_extent") and hasattr(artist, "get_text")):
        if text.get_text() and text.get_visible():
            box = text.get_window_extent()
            assert box.x0 >= 0
            assert box.y0 >= 0
            assert box.x1 <= width
            assert box.y1 <= height


@pytest.mark.parametrize("critical", [0, 17, 58])
def test_label_of_the_critical_contact_stays_clear_of_its_ring(critical):
    figure = draw(grown(60, recent=1), critical=critical, size=(4.5, 2.5))
    axes = figure.axes[0]
    (label,), ring = axes.texts, axes.patches[-1]
    box = label.get_window_extent()
    middle = axes.transData.transform(ring.center)
    gap = np.clip(middle, box.min, box.max) - middle
    assert np.hypot(*gap) > ring.radius


def test_hidden_critical_contact_is_said_to_be_hidden():
    behind = touching([[0, 0, 0], [2, 0, 0], [1, 0, np.sqrt(3)], [1, 0, 2 + np.sqrt(3)]])
    contact = behind.pairs.tolist().index([2, 3])
    assert "critical contact (hidden)" in texts(
        draw(behind, critical=contact, view_direction=(0, 0, 1), dots_per_inch=80)
    )
    assert "critical contact" in texts(draw(behind, critical=contact, view_direction=(0, 1, 0), dots_per_inch=80))


def arrows(figure):
    """Start and end (x, y) of the arrows of the flow."""
    axes = next(axes for axes in figure.axes if "flow" in [text.get_text() for text in axes.texts])
    return [(np.array(text.xyann), np.array(text.xy)) for text in axes.texts if hasattr(text, "xyann")]


def test_flow_arrows_point_outwards_in_extension_and_inwards_in_compression():
    ends = arrows(draw(BENT, flow=simple_shear(2.0), view_direction=(0, 0, 1)))
    assert len(ends) == 4
    for start, end in ends:
        outwards = np.linalg.norm(end) > np.linalg.norm(start)
        assert outwards == (end[0] * end[1] > 0)
        assert abs(end[0]) == pytest.approx(abs(end[1]), rel=1e-3)


@pytest.mark.parametrize("gradient", [np.zeros((3, 3)), np.array([[0, 1, 0], [-1, 0, 0], [0, 0, 0]])])
def test_flow_without_strain_has_no_arrows(gradient):
    assert arrows(draw(BENT, flow=LinearFlow(gradient))) == []


def test_single_sphere_has_a_picture():
    assert (pixels(draw(touching([[0, 0, 0]]), [])) < 0.95).any()


def test_flat_aggregates_have_flat_pictures():
    chain = touching([[2 * k, 0, 0] for k in range(8)])
    heights = [draw(aggregate, dots_per_inch=80).get_figheight() for aggregate in (chain, grown(60))]
    assert heights[0] < 0.5 * heights[1]
    assert heights[1] <= 5.6 + 0.02


def test_importing_the_package_does_not_import_matplotlib():
    code = "import sys, rheoclast.view; sys.exit('matplotlib' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"contact_values": [1.0, 2]}, r"^contact_values: expected one per contact \(5\), got 2$"),
        ({"contact_values": [1, 2, np.nan, 4, 5]}, r"^contact_values\[2\]: expected a finite number, got nan$"),
        ({"contact_values": [[1.0]]}, r"^contact_values: expected shape \(C,\), got \(1, 1\)$"),
        ({"critical": 5}, r"^critical: expected the index of a contact from 0 to 4, got 5$"),
        ({"critical": -1}, r"^critical: expected the index of a contact from 0 to 4, got -1$"),
        ({"critical": 1.0}, r"^critical: expected the index of a contact from 0 to 4, got 1\.0$"),
        ({"critical": True}, r"^critical: expected the index of a contact from 0 to 4, got True$"),
        ({"size": (2.0, 5.0)}, r"^size: expected at least 4\.5 by 2\.5 inches, got 2 by 5$"),
        ({"dots_per_inch": 0}, r"^dots_per_inch: expected a positive number, got 0$"),
        ({"view_direction": (0, 0)}, r"^view_direction: expected shape \(3,\), got \(2,\)$"),
    ],
)
def test_wrong_input_is_refused_in_one_sentence(arguments, message):
    with pytest.raises(ValueError, match=message):
        draw(BENT, **arguments)


def test_critical_contact_of_a_single_sphere_is_refused():
    with pytest.raises(ValueError, match=r"^critical: expected None, as there are no contacts, got 0$"):
        draw(touching([[0, 0, 0]]), critical=0)


class TestForces:
    """Arrows of the fluid's forces."""

    def arrows(self, figure):
        (quiver,) = (each for axes in figure.axes for each in axes.collections if type(each).__name__ == "Quiver")
        return quiver

    def test_arrows_stand_at_the_centres_and_are_proportional_to_the_forces(self):
        """Seen along z: x to the right, y up, the longest 3.5 radii."""
        forces = 1e-9 * np.array([[1.0, 0, 0], [0, 2, 0], [0, 0, 3], [-1, 1, 0], [0, 0, 0], [0.5, 0, 0]])
        quiver = self.arrows(draw(BENT, forces=forces, view_direction=(0, 0, 1)))
        order = np.argsort(-np.linalg.norm(forces, axis=1), kind="stable")
        drawn = np.stack([quiver.U, quiver.V], axis=1)
        centers = BENT.spheres.centers[order, :2]
        pixels_per_metre = np.ptp(quiver.XY[:, 0]) / np.ptp(centers[:, 0])
        np.testing.assert_allclose(drawn, forces[order, :2] * 3.5 * RADIUS * pixels_per_metre / 3e-9, atol=1e-9)
        np.testing.assert_allclose(quiver.XY - quiver.XY[0], (centers - centers[0]) * pixels_per_metre, atol=1e-6)

    def test_what_the_longest_arrow_stands_for(self):
        assert "arrows: force of the fluid, longest 3 nN" in texts(
            draw(BENT, forces=np.full((6, 3), 3e-9 / np.sqrt(3)))
        )

    def test_only_the_largest_of_every_place_of_many(self):
        """A chain of 320 spheres on the x axis: of those in a square of 9 points the one with the largest force."""
        chain = touching([[2 * k, 0, 0] for k in range(320)])
        size = 1 + np.random.default_rng(1).uniform(size=320)
        figure = draw(chain, forces=size[:, None] * [0.0, 1, 0], unit=None, view_direction=(0, 0, 1), dots_per_inch=72)
        quiver = self.arrows(figure)
        (image,) = figure.axes[0].images
        covered = np.flatnonzero((image.get_array()[..., 3] > 0).any(axis=0))
        x = covered[0] + (np.arange(320) + 0.5) * len(covered) / 320
        largest = [size[x // 9 == place].max() for place in np.unique(x // 9)]
        assert quiver.V / quiver.V.max() * size.max() == pytest.approx(sorted(largest)[::-1])
        assert any(f"({len(largest)} of 320 drawn)" in text for text in texts(figure))

    def test_at_most_300(self):
        forces = np.random.default_rng(1).normal(size=(900, 3))
        sheet = touching([[2 * j, 2 * k, 0] for j in range(30) for k in range(30)])
        assert len(self.arrows(draw(sheet, forces=forces, dots_per_inch=72)).U) == 300

    def test_arrows_of_tiny_spheres_are_long_enough_to_be_seen(self):
        chain = touching([[2 * k, 0, 0] for k in range(400)])
        quiver = self.arrows(draw(chain, forces=np.tile([0.0, 1, 0], (400, 1)), view_direction=(0, 0, 1)))
        assert np.hypot(quiver.U, quiver.V) == pytest.approx(18 * 160 / 72)

    def test_no_forces_no_arrows(self):
        figure = draw(BENT, forces=np.zeros((6, 3)))
        assert not any("arrows" in text for text in texts(figure))

    def test_wrong_number(self):
        with pytest.raises(ValueError, match=r"^forces: expected shape \(6, 3\), got \(5, 3\)"):
            draw(BENT, forces=np.zeros((5, 3)))
