"""Reports of impacts."""

from report_files import SVG, Report
from riesel_command import SHIPPED


class Impacts(Report):

    @classmethod
    def setUpClass(cls):
        maker = cls.maker()
        cls.out = maker.run_to_end(SHIPPED / "wall_array.yaml", "wall", "--set",
                                   "impact.axial_velocity={from: 0.3, to: 40, points: 9, spacing: log}")
        cls.page = maker.report_on("wall")

    def page_of(self, directory):
        return super().page_of(self.home / directory)

    def test_the_page_is_well_formed_and_has_the_curves(self):
        self.assertEqual(self.page.mistakes, [])
        names = {path.stem for path in (self.out / "figures").iterdir()}
        self.assertEqual(names, {"dv_y", "contacts", "dv_x", "max_overlap"})
        for name in names:
            legend = self.figure(self.out, name).findall(f"{SVG}g[@class='legend']/{SVG}text")
            self.assertEqual([text.text for text in legend],
                             ["v_x = 0.1 m/s", "v_x = 0.3 m/s", "v_x = 0.5 m/s"])

    def test_lines_go_through_all_points_and_are_dashed_where_they_are_unphysical(self):
        lines = self.figure(self.out, "dv_y").findall(f"{SVG}g[@class='curve']/{SVG}polyline")
        curve = self.summary(self.out)["curve"]
        for is_dashed in (False, True):
            drawn = sum(len(line.get("points").split()) for line in lines
                        if (line.get("stroke-dasharray") is not None) == is_dashed)
            bad = sum(point["verdict"] == "unphysical" for point in curve)
            self.assertGreater(bad, 0)
            self.assertLess(bad, len(curve))
            # the last full point begins the dashed piece
            self.assertEqual(drawn, bad + 3 if is_dashed else len(curve) - bad)
        for criterion in ("more than 0.5 of the braking", "more than 0.5 of the smaller radius",
                          "more than 0.1 of the energy"):
            self.assertIn(criterion, self.page.text)

    def test_every_point_is_in_the_table_and_the_verdicts_are_told(self):
        curve = self.summary(self.out)["curve"]
        for point in curve:
            self.assertIn(f"{point['v_y']:.4g}{point['dv_y']:.4g}{point['dv_x']:.4g}",
                          self.page.text)
        verdicts = [point["verdict"] for point in curve]
        self.assertIn(f"{verdicts.count('unphysical')} unphysical", self.page.text)
        first = min(p["v_y"] for p in curve if p["v_x"] == 0.3 and p["verdict"] == "unphysical")
        self.assertRegex(self.page.text,
                         rf"at v_x = 0.3 m/s \d of 9 points, the first at v_y = {first:.4g} m/s")
        self.assertIn(self.state_hash(self.out), self.page.text)


class ImpactsOfOneVelocity(Report):

    def test_they_are_drawn_as_discs_open_where_the_result_is_unphysical(self):
        for velocity, is_open in (("1 m/s", False), ("40 m/s", True)):
            with self.subTest(velocity):
                out = self.run_to_end(SHIPPED / "wall_array.yaml", velocity, "--set",
                                      f"impact.axial_velocity={velocity}")
                self.assertEqual([point["verdict"] == "unphysical" for point in self.summary(out)["curve"]],
                                 [is_open] * 3)
                self.report_on(out)
                for name in ("dv_y", "contacts", "dv_x", "max_overlap"):
                    discs = self.figure(out, name).findall(f"{SVG}g[@class='curve']/{SVG}circle")
                    self.assertEqual([disc.get("fill") != disc.get("stroke") for disc in discs], [is_open] * 3)
