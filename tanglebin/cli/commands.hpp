#pragma once

namespace CLI {
class App;
}

namespace tanglebin::cli {

// One function and one file per command. It adds the subcommand with its options, help and callback.
// Callbacks throw InputError for bad input; main() turns exceptions into a message and an exit status.
void add_generate(CLI::App& app);
void add_merge(CLI::App& app);
void add_verify(CLI::App& app);
void add_export(CLI::App& app);
void add_scan(CLI::App& app);
void add_preview(CLI::App& app);
void add_view(CLI::App& app);
void add_locate(CLI::App& app);
void add_model(CLI::App& app);
void add_score(CLI::App& app);
void add_experiment(CLI::App& app);
void add_compare(CLI::App& app);
void add_report(CLI::App& app);
void add_learn(CLI::App& app);
void add_calibrate(CLI::App& app);

}  // namespace tanglebin::cli
