"""The z-buffer: what is seen, how large, and in which colour."""

import numpy as np
import pytest

from rheoclast.view.rendering import NOTHING, SPHERE_COLOUR, Collars, render, visible_surface

RED, BLUE = (0.75, 0.06, 0.04), (0.03, 0.22, 0.6)


def no_collars():
    return Collars(np.empty((0, 2), dtype=np.intp), np.empty((0, 3)), np.empty(0), np.empty((0, 3)))


def doublet(colour):
    centers, radii = np.array([[60.0, 60, 0], [140.0, 60, 0]]), np.full(2, 40.0)
    collars = Collars(np.array([[0, 1]]), np.array([[100.0, 60, 0]]), np.array([36.0]), np.array([colour]))
    return render(centers, radii, collars, 200, 120)


@pytest.mark.parametrize("radius", [7.3, 20.0, 44.6])
def test_projected_area_is_that_of_the_disc(radius):
    rendering = render(np.array([[50.2, 49.7, 3.0]]), np.array([radius]), no_collars(), 100, 100)
    assert rendering.image[..., 3].sum() == pytest.approx(np.pi * radius**2, rel=0.01)


def test_depth_of_the_surface_is_that_of_the_sphere():
    depth, owner = visible_surface(np.array([[10.5, 12.5, 5.0]]), np.array([4.0]), 25, 25)
    assert depth[12, 10] == pytest.approx(9.0)
    assert depth[12, 13] == pytest.approx(5 + np.sqrt(16 - 9))
    assert owner[12, 15] == NOTHING
    assert depth[12, 15] == -np.inf


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
def test_nearer_sphere_hides_the_farther_one(order):
    centers = np.array([[50.0, 50, 0], [50.0, 50, 40]])[list(order)]
    owner = render(centers, np.array([20.0, 10.0])[list(order)], no_collars(), 100, 100).owner
    near, far = order.index(1), order.index(0)
    assert owner[50, 50] == near
    assert owner[50, 65] == far
    assert owner[50, 80] == NOTHING


def test_sphere_partly_outside_the_image_is_cut():
    rendering = render(np.array([[0.0, 20, 0], [500.0, 500, 0]]), np.full(2, 10.0), no_collars(), 40, 40)
    assert rendering.image[..., 3].sum() == pytest.approx(np.pi * 50, rel=0.02)


def test_background_is_transparent_and_nothing_is_out_of_range():
    image = doublet(RED).image
    assert image[0, 0, 3] == 0
    assert np.isfinite(image).all()
    assert image.min() >= 0
    assert image.max() <= 1


def test_paint_is_seen_only_around_the_contact_point():
    contact = doublet(RED).contact
    assert contact[60, 98] == contact[60, 102] == 0
    assert contact[60, 40] == contact[60, 160] == NOTHING


@pytest.mark.parametrize(("colour", "sign"), [(RED, 1), (BLUE, -1), (SPHERE_COLOUR, 0)])
def test_paint_has_the_colour_of_its_contact(colour, sign):
    beside_the_contact = doublet(colour).image[60, 95]
    difference = beside_the_contact[0] - beside_the_contact[2]
    assert difference * sign > 0.3 if sign else abs(difference) < 0.05


@pytest.mark.parametrize(("radius", "reach"), [(40.0, 36.0), (3.0, 4.0), (1.0, 2.0)])
def test_collars_are_a_share_of_the_radius_but_not_too_small_to_be_seen(radius, reach):
    collars = Collars.around(np.array([[0, 1]]), np.zeros((1, 3)), np.array([radius]), 0.9, np.array([RED]))
    assert collars.reaches == pytest.approx([reach])


def test_contacts_behind_other_spheres_are_not_seen():
    """Contact 0 joins two spheres that a third hides, contact 1 joins the third and a fourth beside it."""
    centers = np.array([[60.0, 60, -300], [60.0, 60, -380], [60.0, 60, 0], [160.0, 60, 0]])
    radii = np.array([40.0, 40, 50, 50])
    points = np.array([[60.0, 60, -340], [110.0, 60, 0]])
    collars = Collars(np.array([[0, 1], [2, 3]]), points, np.full(2, 36.0), np.array([RED, BLUE]))
    assert set(np.unique(render(centers, radii, collars, 220, 120).contact)) == {NOTHING, 1}


def test_contact_with_a_hidden_sphere_is_seen_on_the_other():
    centers, radii = np.array([[60.0, 60, 0], [120.0, 60, 0], [125.0, 60, 100]]), np.array([40.0, 20, 26])
    collars = Collars(np.array([[0, 1]]), np.array([[100.0, 60, 0]]), np.array([36.0]), np.array([RED]))
    rendering = render(centers, radii, collars, 200, 120)
    assert not (rendering.owner == 1).any()
    assert (rendering.contact[rendering.owner == 0] == 0).any()


def test_spheres_of_a_pixel_are_not_all_rim():
    """They are as bright as large ones, whose rim is a small part of them."""
    brightness = []
    for radius in (1.3, 30.0):
        image = render(np.array([[40.0, 40, 0]]), np.array([radius]), no_collars(), 80, 80).image
        brightness.append(np.average(image[..., :3].mean(axis=2), weights=image[..., 3]))
    assert brightness[0] == pytest.approx(brightness[1], abs=0.1)


def test_paint_does_not_reach_a_third_sphere():
    centers, radii = np.array([[60.0, 60, 0], [140.0, 60, 0], [100.0, 60, 27]]), np.array([40.0, 40, 8])
    collars = Collars(np.array([[0, 1]]), np.array([[100.0, 60, 0]]), np.array([36.0]), np.array([RED]))
    rendering = render(centers, radii, collars, 200, 120)
    assert (rendering.owner == 2).any()
    assert (rendering.contact[rendering.owner == 2] == NOTHING).all()


def test_neighbours_darken_a_sphere_where_they_face_it():
    alone = render(np.array([[60.0, 60, 0]]), np.array([40.0]), no_collars(), 200, 120).image
    beside = doublet(SPHERE_COLOUR).image
    assert beside[60, 90, :3].sum() < 0.9 * alone[60, 90, :3].sum()
    assert beside[60, 30, :3] == pytest.approx(alone[60, 30, :3], abs=0.02)


def test_depth_fades_only_what_is_far():
    centers, radii = np.array([[20.0, 20, 0], [60.0, 20, -4000]]), np.full(2, 10.0)
    image = render(centers, radii, no_collars(), 80, 40).image
    assert image[20, 60, :3].mean() > image[20, 20, :3].mean()
