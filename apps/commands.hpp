#pragma once

namespace CLI {
class App;
}

namespace ppm {

/// Each adds one subcommand to the command line. The command runs while the line is parsed and throws what goes wrong.
void add_run(CLI::App& app);
void add_check(CLI::App& app);
void add_list(CLI::App& app);
void add_describe(CLI::App& app);
void add_schema(CLI::App& app);
void add_graph(CLI::App& app);
void add_evaluate(CLI::App& app);
void add_compare(CLI::App& app);
void add_plot(CLI::App& app);
void add_calibrate(CLI::App& app);
void add_export(CLI::App& app);
void add_new_module(CLI::App& app);
void add_bench(CLI::App& app);

}  // namespace ppm
