#pragma once
// What a person sees of running studies.
#include "engine/study/progress.h"
#include "engine/study/study.h"

namespace cli {

/// Writes to stderr: a bar on a terminal, lines in a log, objects when `json`, nothing when `quiet`.
dem::ProgressPrinter progress_printer(bool quiet, bool json = false);

/// Whether a terminal is there that wants colours (NO_COLOR, TERM).
bool coloured(int file);

/// Tells `progress` what happens to the cases of a study. Keeps a reference to it.
dem::StudyListener progress_listener(dem::ProgressPrinter& progress);

}  // namespace cli
