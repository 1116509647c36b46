// dem-report calibrate: parameters of a rock by what a laboratory measured of it.
#include <fmt/format.h>

#include <unistd.h>

#include <iostream>

#include "engine/core/errors.h"
#include "engine/core/files.h"
#include "engine/core/instruction_set.h"
#include "engine/core/text.h"
#include "engine/study/progress.h"
#include "render/draw.h"
#include "reports/calibration/calibration.h"
#include "reports/calibration/page.h"
#include "reports/calibration/rock_file.h"
#include "reports/commands/again.h"
#include "reports/commands/assets.h"
#include "reports/commands/machine.h"
#include "reports/commands/signals.h"
#include "reports/commands/study_options.h"
#include "reports/commands/terminal.h"
#include "reports/commands/verbs.h"
#include "reports/output/drawing.h"
#include "reports/output/pdf.h"

namespace cli {
namespace {

namespace fs = std::filesystem;

RunRequest request_of(const Arguments& arguments) {
  RunRequest request;
  request.scenarios = arguments.words("SCENARIO");
  request.output = output_folder(arguments.text("output"));
  request.scale = arguments.text("scale");
  request.threads = threads(arguments);
  request.overrides = overrides(arguments);
  request.quiet = arguments.has("quiet");
  const auto& formats = arguments.texts("format");
  request.html = std::ranges::find(formats, "html") != formats.end();
  request.pdf = std::ranges::find(formats, "pdf") != formats.end();
  return request;
}

/// The bar of a trial's tests; whole lines are left to the trials.
dem::StudyListener listener_for(dem::ProgressPrinter& progress) {
  dem::StudyListener listener;
  listener.begin = [&](const std::string& id, int number, int, const std::string&) { progress.begin(id, number); };
  listener.progress = [&](const std::string& id, const dem::Progress& now) { progress.update(id, now); };
  listener.note = [&](const std::string& note) { progress.say(note); };
  listener.end = [&](const dem::CaseOutcome& outcome) {
    progress.end(outcome.id);
    if (outcome.state == dem::CaseState::failed) progress.say(outcome.id + ": failed: " + outcome.error);
  };
  return listener;
}

dem::StudyOptions options_of(const RunRequest& request) {
  dem::StudyOptions options;
  options.output = request.output;
  options.threads = request.threads;
  options.memory = memory_bytes();
  options.stop = &stop_asked();
  return options;
}

/// Where everything of a calibration goes.
struct Places {
  fs::path folder, rock;
};

Places places_of(const RunRequest& request, const dem::Study& study, const std::string& rock) {
  const fs::path whole = request.output / study.folder();
  return {whole / "calibration",
          rock.empty() ? whole / "rocks" / (study.scenario.name() + ".calibrated.toml") : fs::path(rock)};
}

std::string rock_head(const RunRequest& request, const dem::Study& study, const std::string& command) {
  std::string head = fmt::format("# The rock of {}.toml, calibrated to its [measured] at scale {}:\n#\n#     {}\n#\n",
                                 study.scenario.name(), request.scale, command);
  return head + "# Strengths hold for the size and the rates of that scale; check them at another.\n";
}

void write_pages(const RunRequest& request, const dem::Study& study, const calibrate::Outcome& outcome,
                 const calibrate::PageFacts& facts, const Places& places) {
  std::vector<fs::path> charts;
  {
    render::Canvas canvas;
    for (std::size_t s = 0; s < outcome.subjects.size(); ++s) {
      const fs::path chart = places.folder / "figures" / fmt::format("path_{}.svg", s + 1);
      canvas.draw(calibrate::path_chart(outcome.subjects[s]), {}, chart,
                  {{"Scenario", study.scenario.name()}, {"Scale", request.scale}});
      charts.push_back(chart);
    }
  }
  dem::write_file(places.folder / "calibration.json", calibrate::json(outcome, facts));
  const std::string html = calibrate::page(study.scenario, outcome, facts, charts);
  if (request.html) dem::write_file(places.folder / "calibration.html", html);
  if (request.pdf) {
    reports::print_pdf(html, facts.assets / "page" / "print.css", places.folder / "calibration.pdf",
                       {900, [] { return stop_asked().load(); }});
  }
}

int perform(const Arguments& arguments) {
  const RunRequest request = request_of(arguments);
  const std::vector<dem::Study> studies = read_studies(request.scenarios, request.scale, request.overrides);
  const dem::Study& study = studies.front();
  if (!study.model->measurables) {
    throw dem::InputError(dem::Location{study.scenario.file(), 0, 0}, "model",
                          "'" + std::string(study.model->name) + "' cannot be calibrated",
                          "calibrate a scenario of model = \"grain_texture\"");
  }
  const calibrate::Plan plan =
      calibrate::make_plan(study.scenario, study.model->measurables(), study.model->quantities());
  if (request.pdf) reports::check_printing();
  (void)dem::instruction_sets();
  const fs::path assets = assets_folder();
  const Places places = places_of(request, study, arguments.text("rock"));
  listen_to_signals();
  dem::ProgressPrinter progress = progress_printer(request.quiet, false);
  try {
    reports::check_drawing([] { return stop_asked().load(); });
    const calibrate::Listener listener{listener_for(progress), [&](int tests) { progress.start(tests); },
                                       [&](const std::string& line) { progress.say(line); }};
    const calibrate::Outcome outcome = calibrate::calibrate(study, plan, options_of(request), listener);
    calibrate::PageFacts facts;
    facts.scenario = study.scenario.name();
    facts.scale = request.scale;
    facts.engine_version = DEM_VERSION;
    const std::string& rock = study.scenario.text("rock");
    facts.title = rock.empty() ? "Calibration of " + study.scenario.name() : "Calibration of " + rock;
    facts.rock = places.rock.filename().string();
    facts.seed = study.scenario.seed();
    facts.assets = assets;
    facts.again = how_again(request, study.scenario, shipped_scenarios(assets), Home::clone);
    facts.again.command.replace(0, std::string("./dem-report").size(), "./dem-report calibrate");
    facts.rock_text = calibrate::rock_file(study.scenario, *study.model, outcome.values,
                                           rock_head(request, study, facts.again.command));
    dem::write_file(places.rock, facts.rock_text);
    progress.say("drawing the report");
    write_pages(request, study, outcome, facts, places);
    progress.clear();
    if (!request.quiet) {
      for (const std::string& line : calibrate::last_words(outcome)) std::cout << dem::printable(line) << "\n";
      int tests = 0;
      for (const calibrate::SubjectResult& subject : outcome.subjects) tests += subject.tests;
      std::cout << "cost: " << tests << " tests; " << outcome.simulated << " of them were run now, in "
                << dem::duration_text(outcome.seconds) << " added up\n";
      std::cout << "calibrated rock: " << places.rock.string() << "\nreport: "
                << (places.folder / (request.html  ? "calibration.html"
                                     : request.pdf ? "calibration.pdf"
                                                   : "calibration.json"))
                       .string()
                << "\n";
    }
    for (const calibrate::SubjectResult& subject : outcome.subjects) {
      for (const std::string& problem : subject.problems)
        std::cerr << "dem-report: " << subject.subject.title() << ": " << dem::printable(problem, true) << "\n";
    }
    return outcome.is_met() ? 0 : 1;
  } catch (const dem::Interrupted& interrupted) {
    progress.clear();
    std::cerr << "dem-report: stopped; the trials that are done are kept in "
              << (request.output / study.folder()).string() << ": give the same command to go on\n";
    return interrupted.signal != 0 ? 128 + interrupted.signal : exit_code_of_signal();
  }
}

}  // namespace

Command verbs::calibrate() {
  std::vector<ExitCode> codes = usual_exit_codes();
  codes.insert(codes.begin() + 1, {"1", "a measured value is not met; the report and the rock are made all the same"});
  codes.push_back({"129, 130, 143", "stopped by a signal: the same command goes on where it stopped"});
  Positional scenario = scenario_positional();
  scenario.most = 1;
  scenario.help = "a scenario with [measured]";
  return {.name = "calibrate",
          .summary = "find the parameters of a rock by what a laboratory measured of it",
          .details =
              "Moves parameters until tests give the values below [measured]: elastic constants first, then strengths, "
              "boundaries between minerals, and peaks under confining pressure. Every trial is a case and is kept. "
              "Writes DIR/NAME.SCALE/calibration and the rock, to be included, into DIR/NAME.SCALE/rocks.",
          .positionals = {scenario},
          .options = {output_option(),
                      scale_option(),
                      threads_option(),
                      seed_option(),
                      set_option(),
                      {.name = "rock",
                       .value = "FILE",
                       .help = "where to write the calibrated rock instead",
                       .kind = OptionKind::file},
                      {.name = "format",
                       .value = "LIST",
                       .help = "what to make beside calibration.json",
                       .kind = OptionKind::list,
                       .standard = "html,pdf",
                       .choices = {"html", "pdf"}},
                      quiet_option()},
          .examples =
              {{"dem-report calibrate scenarios/my_rock.toml --scale smoke", "a first try, in minutes"},
               {"dem-report scenarios/my_rock.toml --set 'include=\"out/my_rock.smoke/rocks/my_rock.calibrated.toml\"'",
                "a study of the calibrated rock"}},
          .exit_codes = codes,
          .perform = perform};
}

}  // namespace cli
