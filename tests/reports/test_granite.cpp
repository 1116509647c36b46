// Figures of the granite under confining pressure, by dip and of its minerals, from made-up records: what they say of known
// numbers, and that missing cases leave them standing.
#include <doctest/doctest.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "engine/analysis/cracking.h"
#include "engine/analysis/ending.h"
#include "engine/analysis/orientation.h"
#include "render/chart/layout.h"
#include "reports/figures/table.h"
#include "reports/figures/texture/parts.h"
#include "reports/output/summary.h"
#include "reports/published/published.h"
#include "tests/reports/synthetic.h"
#include "tests/support/scratch.h"

namespace {

namespace quantity = dem::texture::quantity;

using doctest::Approx;

constexpr synthetic::Options small{.diameter = 3e-3, .height = 6e-3, .samples = 40};

/// A study whose records are made from one compression test, changed by parameter and result.
struct Made {
  test::Scratch scratch;
  dem::Scenario scenario;
  std::vector<dem::Record> records;

  explicit Made(const std::string& name, const std::string& more = "")
      : scenario(synthetic::scenario(scratch.path(), name, more, "paper")) {}  // numbers are judged at this scale

  static const dem::Record& pattern() {
    static const dem::Record record = synthetic::compression(1, small);
    return record;
  }
  dem::Record& add(const std::string& id, const std::string& test, double pressure, double dip,
                   const std::string& mineral, double seed) {
    dem::Record record = pattern();
    record.case_id = id;
    record.seed = static_cast<std::uint64_t>(seed);
    record.parameters = {{"test", test},
                         {"aspect_ratio", 1.0},
                         {"dip", dip},
                         {"mineral", mineral},
                         {"confining_pressure", pressure},
                         {"seed", seed},
                         {"seed_scale", 0.669},
                         {"growth", "deepest_contact"},
                         {"between", "minerals"},
                         {"pressure_ratio", 0.01}};
    std::erase_if(record.results, [](const auto& r) {
      return r.first == "compressive_strength" || r.first == "crack_damage" ||
             r.first == "crack_initiation.axial_stiffness";
    });
    records.push_back(record);
    return records.back();
  }
  void add_confined(double pressure, const std::string& mineral = "", double more = 0, double seed = 1) {
    std::string id = "compression_" + (mineral.empty() ? "ar_1" : mineral);
    if (pressure > 0) id += "_sigma3_" + std::to_string(static_cast<int>(pressure));
    if (seed > 1) id += "_seed_" + std::to_string(static_cast<int>(seed));
    dem::Record& record = add(id, "compression", pressure, 0, mineral, seed);
    record.put(quantity::compressive_strength, dem::analysis::hoek_brown(pressure, 206, 29, 1) + more);
    record.put(quantity::crack_damage, dem::analysis::hoek_brown(pressure, 206, 16, 0.6) + more);
    record.put(quantity::initiation_by_stiffness, 71.1 + 1.1 * pressure);
    record.put(quantity::residual_over_peak, 0.2 + 0.01 * pressure);
    if (pressure > 0) record.put(quantity::servo_error, 0.004);
  }
  [[nodiscard]] reports::StudyResult study() const { return synthetic::study_of(scenario, records); }
};

void set_table(dem::Record& record, const dem::Table& table) {
  *std::ranges::find(record.tables, table.name, &dem::Table::name) = table;
}

// Up to the peak at 1 + pressure / 10 (%), down to 0.4 + pressure / 100 of it, and further down from 0.5 % after the peak on;
// without pressure the test ends 0.3 % after its peak.
void set_history(dem::Record& record, double pressure) {
  const double peak = 1 + pressure / 10, level = 0.4 + 0.01 * pressure, reach = pressure == 0 ? 0.3 : 2;
  dem::Table history{.name = "history", .attributes = {}, .columns = {}};
  std::vector<double> strain, stress;
  for (double e = 0.05; e < peak + reach + 1e-6; e += 0.01) {
    strain.push_back(e / 100);
    stress.push_back(1e8 * (e < peak + 1e-6 ? e / peak : e < peak + 0.5 ? level : 0.1));
  }
  history.add("platen_strain", "1", strain);
  history.add("axial_stress", "Pa", stress);
  set_table(record, history);
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + " ";
  return text;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE("envelopes are fitted through the cases of a study, each rock or mineral on its own") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 5.0, 10.0, 20.0, 40.0, 60.0}) made.add_confined(pressure);
  made.add_confined(20, "quartz", 300);
  const auto found = reports::texture::envelopes_of(made.study());
  CHECK(found.find("peak.m")->value == Approx(29).epsilon(1e-6));
  CHECK(found.find("free.sigma_c")->value == Approx(206).epsilon(1e-6));
  CHECK(found.find("free.m")->value == Approx(29).epsilon(1e-6));
  CHECK(found.find("damage.s")->value == Approx(0.6).epsilon(1e-6));
  CHECK(found.find("initiation.axial_stiffness.slope")->value == Approx(1.1));
  CHECK_FALSE(reports::texture::envelopes_of(made.study(), "quartz").find("peak.m"));
  CHECK(reports::texture::envelopes_of(made.study(), "quartz").peak.sigma_3.size() == 1);
}

TEST_CASE("figures under confinement say what the records hold") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0, 40.0}) made.add_confined(pressure);
  const auto envelopes = reports::texture::confinement_envelopes(made.study());
  CHECK(envelopes.panels.size() == 2);
  CHECK(has(envelopes.finding, "m 29"));
  CHECK(has(envelopes.finding, "95 % interval"));
  const std::string maps = reports::texture::confinement_crack_maps(made.study()).finding;
  CHECK(has(maps, "Cracks at the peak"));
  CHECK(has(maps, "where the stress has fallen to 90 % of the peak"));
  CHECK(has(maps, "mean angle of those at the end of loading to the axis is"));
  CHECK(has(envelopes.finding, "inside the range of Eq. 12"));
  const auto after = reports::texture::confinement_after_peak(made.study());
  CHECK(has(after.finding, "0.20, 0.30 and 0.60"));
  CHECK(has(after.finding, "within 0.40 %"));
  CHECK(has(reports::texture::confinement_curves(made.study()).finding, "206"));
  CHECK(reports::texture::crack_orientation(made.study()).panels.size() == 3);
  const auto counts = reports::texture::confinement_crack_counts(made.study());
  REQUIRE(counts.panels.size() == 5);  // numbers and shares, at the peak and at the end, and the slopes
  CHECK(counts.panels[0].id == "peak_numbers");
  CHECK(counts.panels[2].id == "numbers");
  for (const std::size_t chart : {0, 1, 2, 3})
    CHECK(has(std::get<render::Chart>(counts.panels[chart].content).x.title, "σ₃"));
  const auto& slopes = std::get<reports::TextTable>(counts.panels[4].content);
  CHECK(slopes.head[1] == "Slope per MPa of confining pressure");
  CHECK(slopes.rows.size() == 4);
  CHECK(has(counts.finding, "Slopes per MPa of confining pressure: "));
  CHECK(has(counts.finding, "one seed cannot show a trend"));
}

TEST_CASE("a test that is followed further gives its energies where its cracks end, and marks that place") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0}) made.add_confined(pressure);
  const auto marked = [&] {
    std::size_t marks = 0;
    for (const reports::Panel& panel : reports::texture::energy_compression(made.study()).panels) {
      const auto* chart = std::get_if<render::Chart>(&panel.content);
      if (chart)
        marks += static_cast<std::size_t>(std::ranges::count(chart->marks, "end of loading", &render::Mark::label));
    }
    return marks;
  };
  const std::size_t before = marked();
  dem::Record& followed = made.records.back();
  const dem::Table& history = followed.table("history");
  const std::size_t row = history.rows() - 5;
  for (dem::Table& table : followed.tables) {
    if (!table.name.starts_with("snapshots/") || table.attribute("moment") != "end") continue;
    for (auto& [key, value] : table.attributes) {
      if (key == "strain") value = fmt::format("{:.6g}", history.real("axial_strain")[row]);
      if (key == "stress") value = fmt::format("{:.6g}", history.real("axial_stress")[row]);
    }
  }
  CHECK(dem::analysis::end_of_loading(followed) == row);
  CHECK(marked() == before + 2);  // in its energies and in what it dissipated
  CHECK(has(reports::texture::energy_compression(made.study()).finding, "shares of the work at the end of loading: "));
}

TEST_CASE("a plateau that the start of the platens leaves uneven is told") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0}) {
    made.add_confined(pressure);
    dem::Table history{.name = "history", .attributes = {}, .columns = {}};
    std::vector<double> strain, stress, stiffness;
    for (int i = 0; i <= 100; ++i) {
      strain.push_back(1e-4 * i);
      stress.push_back(1e6 * (pressure + i));
      stiffness.push_back(pressure == 0 || i % 2 == 0 ? 70e9 : 77e9);
    }
    history.add("axial_strain", "1", strain);
    history.add("axial_stress", "Pa", stress);
    history.add("axial_stiffness", "Pa", stiffness);
    set_table(made.records.back(), history);
  }
  const std::string finding = reports::texture::confinement_curves(made.study()).finding;
  CHECK(has(finding, "more than the 2 % that mark initiation"));
  CHECK(has(finding, "At σ₃ 10 MPa (± 4.8 %) the stiffness"));
}

TEST_CASE("stresses after the peak are compared at one strain after it, as far as the shortest test goes") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0, 40.0}) {
    made.add_confined(pressure);
    set_history(made.records.back(), pressure);
  }
  CHECK(has(reports::texture::confinement_after_peak(made.study()).finding,
            "At 0.30 % of strain of the ends after the peak the stress is 0.40, 0.50 and 0.80 of the peak"));
}

TEST_CASE("verdicts read stresses after the peak and directions of cracks from the tables") {
  Made made("ldb_confinement");
  for (const double seed : {1.0, 2.0, 3.0}) {
    for (const double pressure : {0.0, 10.0, 40.0}) {
      made.add_confined(pressure, "", 0, seed);
      set_history(made.records.back(), pressure);
      dem::Table cracks{.name = "cracks", .attributes = {}, .columns = {}};
      const double angle = (50 - pressure) * std::numbers::pi / 180;  // of the plane to the axis
      cracks.add("normal", "1", std::vector<double>{std::cos(angle), 0, std::sin(angle)}, 3);
      cracks.add("area", "m^2", std::vector<double>{1});
      cracks.add("mode", "", std::vector<std::int32_t>{0});
      set_table(made.records.back(), cracks);
    }
  }
  const auto rows = reports::compare(made.study(), std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers").rows;
  const auto row = [&](const std::string& id) {
    const auto found = std::ranges::find(rows, id, &reports::Comparison::id);
    REQUIRE(found != rows.end());
    return *found;
  };
  const auto after = row("trend_stress_after_peak_with_pressure"), angle = row("trend_crack_angle_with_pressure");
  CHECK(after.verdict == reports::Verdict::met);
  CHECK(after.outcome == reports::Verdict::met);
  CHECK(has(after.detail, "0.4000 → 0.5000 → 0.8000; not run: 5, 20, 60"));
  CHECK(angle.verdict == reports::Verdict::missed);
  CHECK(angle.outcome == reports::Verdict::missed);
  CHECK(has(angle.detail, "50.00 → 40.00 → 10.00; not run: 5, 20, 60"));
}

TEST_CASE("figures show what the paper states beside ours, and nothing for another rock") {
  const auto labels = [](const reports::FigureContent& content) {
    std::vector<std::string> found;
    const auto& chart = std::get<render::Chart>(content.panels.at(0).content);
    for (const render::Series& series : chart.series) found.push_back(series.label);
    for (const render::Mark& mark : chart.marks) found.push_back(mark.label);
    return joined(found);
  };
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0, 40.0}) made.add_confined(pressure);
  for (const double pressure : {0.0, 10.0, 40.0}) made.add_confined(pressure, "quartz", 200);
  reports::StudyResult study = made.study();
  using reports::texture::confinement_envelopes, reports::texture::progressive_failure,
      reports::texture::mineral_envelopes;
  const auto curves = [&] {
    return std::get<render::Chart>(mineral_envelopes(study).panels.at(0).content).series.size();
  };
  CHECK_FALSE(has(labels(confinement_envelopes(study)), "published"));
  CHECK_FALSE(has(labels(progressive_failure(study)), "published"));
  CHECK(curves() == 3);  // points, our fit, and the key of fits

  study.published = reports::published_numbers(study, std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers");
  CHECK(has(labels(confinement_envelopes(study)), "published fits"));
  CHECK(has(labels(confinement_envelopes(study)), "Martin’s laboratory peak"));
  CHECK(has(labels(confinement_envelopes(study)), "range of Eq. 12 for σ_{ci}, with our UCS"));
  const auto table = std::get<reports::TextTable>(confinement_envelopes(study).panels.at(1).content);
  std::vector<std::string> published;
  for (const auto& row : table.rows) published.push_back(row[2]);
  CHECK(joined(published).starts_with("29 206 29 16 0.6 71.1 1.1 "));
  CHECK(has(labels(progressive_failure(study)), "published σ_{ci} and σ_{cd} published peak"));
  CHECK(curves() == 5);
  const auto mineral = std::get<reports::TextTable>(reports::texture::mineral_properties(study).panels.front().content);
  REQUIRE(mineral.rows.size() == 1);
  CHECK(has(mineral.rows[0][3], " / 418"));
  const auto inputs = reports::texture::input_parameters(study).panels.back();
  CHECK(std::get<reports::TextTable>(inputs.content).rows ==
        std::vector<std::vector<std::string>>{{"density (kg/m³)", "2640"},
                                              {"Young’s modulus (GPa)", "69–71"},
                                              {"Poisson’s ratio", "0.26"},
                                              {"friction coefficient", "0.6"},
                                              {"UCS (MPa)", "200–228"},
                                              {"TS (MPa)", "9.3–13.4"},
                                              {"Hoek–Brown m", "28–34"}});
}

TEST_CASE("circles of Mohr are those of the mean peaks, round, and touched by the envelope") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0, 40.0}) {
    made.add_confined(pressure, "", -4, 1);
    made.add_confined(pressure, "", +4, 2);
  }
  auto content = reports::texture::confinement_mohr(made.study());
  reports::lay_out(content.panels);
  const auto& chart = std::get<render::Chart>(content.panels.front().content);
  std::vector<std::array<double, 2>> circles;  // middle, radius
  for (const render::Series& s : chart.series) {
    if (s.y.front() != 0 || s.y.back() != 0) continue;
    circles.push_back({0.5 * (s.x.front() + s.x.back()), 0.5 * (s.x.back() - s.x.front())});
  }
  REQUIRE(circles.size() == 3);
  CHECK(circles[0][1] == Approx(0.5 * 206));
  CHECK(circles[2][0] == Approx(0.5 * (40 + dem::analysis::hoek_brown(40, 206, 29, 1))));
  const auto envelope = std::ranges::find(chart.series, "Hoek-Brown, peak", &render::Series::label);
  REQUIRE(envelope != chart.series.end());
  for (const auto& [middle, radius] : circles) {
    double least = 1e9;
    for (std::size_t i = 0; i < envelope->x.size(); ++i)
      least = std::min(least, std::hypot(envelope->x[i] - middle, envelope->y[i]));
    CHECK(least == Approx(radius).epsilon(2e-3));
  }
  const render::Rect area{0, 0, static_cast<double>(chart.width), static_cast<double>(chart.height)};
  const render::ChartLayout layout = render::lay_out(chart, area, 12, chart.legend);
  const double across = layout.across(100) - layout.across(0);
  const double up = layout.down(0, render::Side::left) - layout.down(100, render::Side::left);
  CHECK(up == Approx(across).epsilon(0.03));
}

TEST_CASE("a specimen that is cut through is two parts, and a cut is the plane of its poles") {
  Made made("ldb_confinement");
  made.add_confined(0);
  dem::Record& record = made.records.front();
  const dem::Table& contacts = record.table("contacts");
  const auto pair = contacts.integer("pair"), kind = contacts.integer("kind");
  const auto place = record.table("particles").real("position");
  dem::Table cracks{"cracks", {}, {}};
  std::vector<double> time, position, normal, area;
  std::vector<std::int32_t> contact, none;
  for (std::size_t c = 0; c < kind.size(); ++c) {  // every bond across half the height breaks
    const double low = place[3 * static_cast<std::size_t>(pair[2 * c]) + 2],
                 high = place[3 * static_cast<std::size_t>(pair[2 * c + 1]) + 2];
    if ((low < 3e-3) == (high < 3e-3)) continue;
    for (int element = 0; element < (kind[c] == 0 ? 3 : 1); ++element) {
      time.push_back(1e-3);
      position.insert(position.end(), {0, 0, 3e-3});
      normal.insert(normal.end(), {0, 0, 1});
      area.push_back(1e-8);
      contact.push_back(static_cast<std::int32_t>(c));
      none.push_back(0);
    }
  }
  REQUIRE(contact.size() > 10);
  cracks.add("time", "s", time);
  cracks.add("strain", "1", time);
  cracks.add("position", "m", position, 3);
  cracks.add("normal", "1", normal, 3);
  cracks.add("area", "m^2", area);
  for (const char* name : {"mode", "place", "mineral_a", "mineral_b"}) cracks.add(name, "", none);
  cracks.add("contact", "", contact);
  set_table(record, cracks);
  CHECK(has(reports::texture::fragments(made.study()).finding, "2 parts above 5 % of the volume"));
  CHECK(has(reports::texture::crack_directions(made.study()).finding, "dipping 0° towards"));
}

TEST_CASE("figures stand with one case and with none") {
  for (const std::size_t cases : {0UL, 1UL}) {
    Made made("ldb_confinement");
    if (cases == 1) made.add_confined(10);
    for (const reports::Figure& figure : reports::figures()) {
      if (figure.model != "grain_texture") continue;
      CAPTURE(figure.id);
      CHECK_NOTHROW((void)figure.make(made.study()));
    }
  }
}

TEST_CASE("what a parameter does is told seed by seed, and apart from scatter") {
  Made made("ldb_sensitivity", "sensitivity.factor = 1.2");
  const auto add = [&](const std::string& raised, double seed, double pressure, double ucs) {
    dem::Record& record = made.add(fmt::format("c{}", made.records.size()), "compression", pressure, 0, "", seed);
    record.parameters.emplace_back("raised", raised);
    record.put(quantity::compressive_strength, ucs);
  };
  // Specimens scatter by 5 %, and the cohesion adds a tenth to each; friction does now this, now that.
  constexpr std::array base{200.0, 210.0, 190.0}, friction{1.04, 0.97, 1.01};
  for (std::size_t k = 0; k < base.size(); ++k) {
    const double seed = static_cast<double>(k + 1);
    for (const double pressure : {0.0, 20.0}) {
      const double peak = dem::analysis::hoek_brown(pressure, base[k], 29, 1);
      add("", seed, pressure, peak);
      add("cohesion", seed, pressure, dem::analysis::hoek_brown(pressure, 1.1 * base[k], 1.2 * 29, 1));
      add("interaction.friction", seed, pressure, friction[k] * peak);
    }
  }
  const auto& figures = reports::figures();
  const auto figure = std::ranges::find(figures, "sensitivities", &reports::Figure::id);
  const reports::FigureContent content = figure->make(made.study());
  CHECK(has(content.finding, "UCS by C_b (+10.0 ± 0.0 %)"));
  CHECK(has(content.finding, "m by C_b (+20.0 ± 0.0 %)"));
  const auto table = std::ranges::find(content.panels, "table", &reports::Panel::id);
  REQUIRE(table != content.panels.end());
  const auto& rows = std::get<reports::TextTable>(table->content);
  const auto column = std::ranges::find(rows.head, "UCS (%)") - rows.head.begin();
  REQUIRE(rows.rows.size() == 2);
  CHECK(rows.rows[1].front() == "α_μ, friction (1)");
  CHECK(rows.rows[1].at(static_cast<std::size_t>(column)) == "+0.7 ± 3.5");
  CHECK(rows.rows[0].at(static_cast<std::size_t>(std::ranges::find(rows.head, "TS (%)") - rows.head.begin())) == "–");
}

TEST_CASE("repeats give means, error bars and trends paired by seed") {
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 20.0, 40.0}) {
    made.add_confined(pressure, "", -3, 1);
    made.add_confined(pressure, "", +3, 2);
    made.add_confined(pressure, "", 0, 3);
  }
  const auto cases = reports::texture::swept(made.study(), "compression");
  REQUIRE(cases.size() == 3);
  const auto damage = dem::analysis::spread(cases[0], reports::shown(quantity::crack_damage));
  CHECK(damage.mean == Approx(206 * std::sqrt(0.6)));
  CHECK(damage.deviation == Approx(3));
  CHECK(reports::means(cases, reports::shown(quantity::crack_damage)).y_error.size() == 3);
  const auto trend = reports::trend_of(cases, reports::shown(quantity::crack_damage));
  CHECK(trend->seeds == 3);
  CHECK(trend->is_clear());
  CHECK(has(reports::trend_words(cases, reports::shown(quantity::crack_damage), "MPa",
                                 dem::texture::parameter::confining_pressure),
            "rises by"));
  CHECK(has(reports::trend_words(cases, reports::shown(quantity::young_modulus), "GPa",
                                 dem::texture::parameter::confining_pressure),
            "no clear trend"));
}

TEST_CASE("published numbers of the granite are compared with fits, means and trends") {
  const auto rows_of = [](const reports::StudyResult& study) {
    return reports::compare(study, std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers").rows;
  };
  const auto row = [](const std::vector<reports::Comparison>& rows, const std::string& id) {
    const auto found = std::ranges::find(rows, id, &reports::Comparison::id);
    REQUIRE(found != rows.end());
    return *found;
  };
  Made made("ldb_confinement");
  for (const double pressure : {0.0, 10.0, 40.0}) {
    made.add_confined(pressure, "", -3, 1);
    made.add_confined(pressure, "", +3, 2);
  }
  CHECK(row(rows_of(made.study()), "trend_residual_with_pressure").verdict ==
        reports::Verdict::undecided);  // two seeds
  for (const double pressure : {0.0, 10.0, 40.0}) made.add_confined(pressure, "", 0, 3);
  const auto rows = rows_of(made.study());
  const auto m = row(rows, "envelope_peak_m");
  CHECK(m.verdict == reports::Verdict::met);
  CHECK(m.outcome == reports::Verdict::met);
  CHECK(has(m.detail, "95 % interval"));
  const auto ucs = row(rows, "ucs_ar_1");
  CHECK(std::get<double>(*ucs.computed) == Approx(206));
  CHECK(has(ucs.detail, "mean of 3 seeds"));
  const auto residual = row(rows, "trend_residual_with_pressure");
  CHECK(residual.verdict == reports::Verdict::met);
  CHECK(residual.outcome == reports::Verdict::met);
  CHECK(has(residual.detail, "not run: 5, 20, 60"));
  CHECK(has(residual.detail, "p = "));
  const auto json = reports::summary_json(made.study(), {"", "", rows}, {}, "0.1.0");
  CHECK(has(json, "\"p_value\": "));
  REQUIRE(m.estimate);
  CHECK(m.estimate->low < 29);
  CHECK(m.estimate->high > 29);
  CHECK(residual.estimate->value == Approx(0.01));
}

TEST_CASE("each topic of the granite has its published numbers, with unlike ids") {
  for (const std::string topic : {"uniaxial", "confinement", "dip_angle", "minerals"}) {
    CAPTURE(topic);
    const Made made("study", "published = [\"" + topic + "\"]");
    const auto rows = reports::compare(made.study(), std::filesystem::path(DEM_SOURCE_DIR) / "assets/papers").rows;
    CHECK(rows.size() >= 10);
    std::vector<std::string> ids;
    for (const auto& row : rows) {
      CHECK(row.verdict == reports::Verdict::not_computed);
      ids.push_back(row.id);
    }
    std::ranges::sort(ids);
    CHECK(std::ranges::adjacent_find(ids) == ids.end());
  }
}

TEST_CASE("directions of cracks are weighted by area and told apart by mode") {
  dem::Table cracks{.name = "cracks", .attributes = {}, .columns = {}};
  cracks.add("normal", "1", std::vector<double>{1, 0, 0, 0, 0, -1, 0, std::sqrt(0.5), std::sqrt(0.5)}, 3);
  cracks.add("area", "m^2", std::vector<double>{2, 1, 1});
  cracks.add("mode", "", std::vector<std::int32_t>{0, 0, 1});
  const auto all = dem::analysis::orientation_of(cracks, 0);
  CHECK(all.mean == Approx((2 * 0.0 + 90 + 45) / 4));
  CHECK(all.along == Approx(0.5));
  CHECK(all.share.front() == Approx(0.5));
  CHECK(all.share.back() == Approx(0.25));
  CHECK(dem::analysis::orientation_of(cracks, 0, 1).mean == Approx(45));
  CHECK(dem::analysis::orientation_of(cracks, 1, 0).mean == Approx(90));
  CHECK(std::isnan(dem::analysis::orientation_of(cracks, 3).mean));
}

TEST_CASE("a band of cracks is found at its angle to the axis") {
  std::vector<double> particle, volume;
  for (int x = -10; x <= 10; ++x) {
    for (int y = -10; y <= 10; ++y) {
      for (int z = -20; z <= 20; ++z) {
        if (x * x + y * y > 100) continue;
        particle.insert(particle.end(), {0.1 * x, 0.1 * y, 0.1 * z});
        volume.push_back(1);
      }
    }
  }
  for (const int angle : {0, 25, 60}) {
    CAPTURE(angle);
    const double a = angle * std::numbers::pi / 180;
    std::vector<double> crack;
    for (std::size_t i = 0; i < volume.size(); ++i) {
      const double distance = std::cos(a) * particle[3 * i] + std::sin(a) * particle[3 * i + 2];
      if (std::abs(distance) < 0.15)
        crack.insert(crack.end(), {particle[3 * i], particle[3 * i + 1], particle[3 * i + 2]});
    }
    const std::vector<double> area(crack.size() / 3, 1.0);
    const auto band = dem::analysis::densest_band(crack, area, particle, volume, 0.35);
    CHECK(std::abs(band.inclination - angle) <= 5);
    CHECK(band.cracks > 0.8);
    CHECK(band.concentration() > 2);
    std::vector<std::int32_t> contact(area.size());
    std::iota(contact.begin(), contact.end(), 0);
    const double at_random = dem::analysis::excess_at_random(contact, area, particle, volume, 0.35, 3);
    CHECK(at_random > 0);
    CHECK(at_random < 0.2 * band.excess());
  }
}

TEST_CASE("cracks are shared out by number, contact and area, and groups of contacts by how often they crack") {
  Made made("ldb_uniaxial");
  made.add_confined(0);
  dem::Record& record = made.records.back();
  // Two contacts inside grains and two between; of the first three elements break, one of the third.
  const auto column = [](dem::Table& table, const char* name, std::vector<std::int32_t> values, int wide = 1) {
    table.add(name, "", std::move(values), wide);
  };
  dem::Table contacts{.name = "contacts", .attributes = {}, .columns = {}}, cracks = contacts;
  cracks.name = "cracks";
  const auto mineral = record.table("particles").integer("mineral");
  const auto other = static_cast<std::int32_t>(
      std::ranges::find_if(mineral, [&](std::int32_t m) { return m != mineral[0]; }) - mineral.begin());
  REQUIRE(static_cast<std::size_t>(other) < mineral.size());
  column(contacts, "pair", {0, 0, 0, 0, 0, other, 0, other}, 2);
  column(contacts, "place", {0, 0, 1, 1});
  column(cracks, "mode", {0, 1, 1, 0});
  column(cracks, "place", {0, 0, 0, 1});
  column(cracks, "contact", {0, 0, 0, 2});
  cracks.add("area", "m^2", std::vector<double>{1, 1, 1, 3});
  set_table(record, contacts);
  set_table(record, cracks);
  const auto found = dem::analysis::cracking_until(record, "");
  CHECK(found.all().number == 4);
  CHECK(found.all().contacts == 2);
  CHECK(found.classes[0][0].contacts == 1);  // by its first crack
  CHECK(found.classes[0][1].contacts == 0);
  CHECK(found.classes[0][1].number == 2);
  CHECK(found.classes[1][0].area / found.all().area == Approx(0.5));
  REQUIRE(found.groups.size() == 2);
  CHECK(found.groups[0].place == 0);
  for (const auto& group : found.groups) CHECK(found.exposure(group) == Approx(1));
}

TEST_CASE("the figure of crack exposure tells both moments, and stands without cracks or cases") {
  Made made("ldb_uniaxial");
  made.add_confined(0);
  const auto content = reports::texture::crack_exposure(made.study());
  std::string ids;
  for (const auto& panel : content.panels) ids += panel.id + " ";
  CHECK(ids == "peak end classes groups ");
  CHECK(has(content.finding, "inter-grain contacts are "));

  Made none("ldb_uniaxial");
  none.add_confined(0);
  dem::Table empty = none.records.back().table("cracks");
  for (auto& c : empty.columns) std::visit([](auto& values) { values.clear(); }, c.values);
  set_table(none.records.back(), empty);
  CHECK_FALSE(reports::texture::crack_exposure(none.study()).panels.empty());
  CHECK(reports::texture::crack_exposure(none.study()).finding.empty());
}
