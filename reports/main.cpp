// dem-report: chooses a command, performs it, and turns what went wrong into an exit code.
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "engine/core/errors.h"
#include "engine/core/text.h"
#include "reports/commands/last_words.h"
#include "reports/commands/night.h"
#include "reports/commands/parse.h"
#include "reports/commands/table.h"

namespace {

// Names of files, keys and what other tools said may hold what a terminal obeys.
void tell(const std::string& what) { std::cerr << "dem-report: " << dem::printable(what, true) << "\n"; }

int perform(int argc, char** argv) {
  try {
    const cli::Call call = cli::parse(cli::commands(), std::vector<std::string>(argv + 1, argv + argc));
    return call.command->perform(call.arguments);
  } catch (const dem::InputError& error) {
    tell(error.what());
    cli::annotate(error);
    return 2;
  } catch (const dem::EnvironmentError& error) {
    tell(error.what());
  } catch (const std::bad_alloc&) {
    std::cerr << "dem-report: out of memory; try a smaller --scale\n";
  } catch (const std::system_error& error) {
    std::cerr << "dem-report: the machine is in the way: " << error.what() << "\n";
  } catch (const std::exception& error) {
    tell(std::string("internal error: ") + error.what());
  }
  return 3;
}

}  // namespace

int main(int argc, char** argv) {
  cli::prepare_last_words();
  return cli::leave_with(perform(argc, argv));
}
