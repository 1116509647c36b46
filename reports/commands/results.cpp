// dem-report results: what the cases of each model give and differ in. docs/use/results.md is what `results --markdown`
// prints.
#include <fmt/format.h>

#include <iostream>

#include "engine/model/model.h"
#include "reports/commands/verbs.h"

namespace cli {
namespace {

std::string_view kind_word(const dem::Quantity& quantity) {
  if (quantity.kind == dem::QuantityKind::count) return "count";
  return quantity.kind == dem::QuantityKind::diagnostic ? "diagnostic" : "result";
}

std::string unit_text(const dem::Quantity& quantity) {
  const std::string stored(quantity.unit.empty() ? "–" : quantity.unit);
  return quantity.shown.empty() ? stored : fmt::format("{} (shown in {})", stored, quantity.shown);
}

std::string given_by(const dem::Quantity& quantity) {
  return quantity.tests.empty() ? "every test" : std::string(quantity.tests);
}

std::string meaning(const dem::Quantity& quantity) {
  std::string text(quantity.meaning);
  if (quantity.of_size) text += " Grows with the specimen.";
  if (quantity.scatter > 0) text += fmt::format(" Between seeds: {:.1f} %.", 100 * quantity.scatter);
  return text;
}

std::string where_from(const dem::Parameter& parameter) {
  return parameter.key.empty() ? fmt::format("{}", parameter.usual) : fmt::format("the key {}", parameter.key);
}

std::string plain(const dem::Model& model) {
  std::string text = fmt::format("Results of model = \"{}\"\n", model.name);
  for (const dem::Quantity& q : model.quantities()) {
    text += fmt::format(
        "  {}: {}{}, {}; {} of {}\n      {}\n", q.id, q.name, q.symbol.empty() ? "" : fmt::format(", {}", q.symbol),
        q.unit.empty() && q.shown.empty() ? "no unit" : "in " + unit_text(q), kind_word(q), given_by(q), meaning(q));
  }
  text += fmt::format("\nParameters of its cases\n");
  for (const dem::Parameter& p : model.parameters()) {
    text += fmt::format("  {}: {}{}; else {}\n", p.id, p.name, p.unit.empty() ? "" : fmt::format(", in {}", p.unit),
                        where_from(p));
  }
  return text;
}

std::string markdown(const dem::Model& model) {
  std::string text = fmt::format(
      "\n## {}\n\n| id | name | symbol | unit | kind | given by | how it is measured |\n"
      "|---|---|---|---|---|---|---|\n",
      model.name);
  for (const dem::Quantity& q : model.quantities()) {
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} | {} |\n", q.id, q.name, q.symbol, unit_text(q), kind_word(q),
                        given_by(q), meaning(q));
  }
  text += "\n| parameter | name | unit | where nothing sweeps it |\n|---|---|---|---|\n";
  for (const dem::Parameter& p : model.parameters()) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", p.id, p.name, p.unit, where_from(p));
  }
  return text;
}

int perform(const Arguments& arguments) {
  const std::string& wanted = arguments.word("MODEL");
  const bool as_page = arguments.has("markdown");
  if (as_page) {
    std::cout
        << "# Results\n\nThe output of `dem-report results --markdown`. A result has its id in records and in "
           "`summary.json`, where its number is\nin the unit given here; reports show it in the unit in brackets. "
           "`family.*` stands for one result a member.\n";
  }
  bool first = true;
  for (const dem::Model& model : dem::models()) {
    if (!wanted.empty() && model.name != wanted) continue;
    std::cout << (as_page || first ? "" : "\n") << (as_page ? markdown(model) : plain(model));
    first = false;
  }
  return 0;
}

}  // namespace

Command verbs::results() {
  std::vector<std::string> models;
  for (const dem::Model& model : dem::models()) models.emplace_back(model.name);
  return {.name = "results",
          .summary = "list what cases give: results with unit and meaning, and the parameters of cases",
          .positionals = {{.name = "MODEL", .help = "only those of this model", .least = 0, .choices = models}},
          .options = {{.name = "markdown", .help = "as a page in Markdown: docs/use/results.md is made with it"}},
          .examples = {{"dem-report results grain_texture", "what a test of a granite tells"}},
          .exit_codes = usual_exit_codes(),
          .perform = perform};
}

}  // namespace cli
