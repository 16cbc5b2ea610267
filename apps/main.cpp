#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "apps/commands.hpp"
#include "framework/core/error.hpp"
#include "framework/graph/abi.hpp"

namespace {

constexpr int kInputIsWrong = 2;
constexpr int kFailed = 1;

int report(const std::exception& error, int code) {
  std::fprintf(stderr, "%s\n", error.what());
  return code;
}

int run_command(int argc, char** argv) {
  CLI::App app("3-D SLAM with range cameras on probabilistic polygonal meshes.", "ppm");
  app.set_version_flag("--version", "ppm " PPM_VERSION);
  app.require_subcommand(1);
  app.footer("Exit codes: 0 done; 2 the input is wrong (the message says where and why); 1 anything else.");
  ppm::add_run(app);
  ppm::add_check(app);
  ppm::add_list(app);
  ppm::add_describe(app);
  ppm::add_schema(app);
  ppm::add_graph(app);
  ppm::add_evaluate(app);
  ppm::add_compare(app);
  ppm::add_plot(app);
  ppm::add_calibrate(app);
  ppm::add_export(app);
  ppm::add_new_module(app);
  ppm::add_bench(app);
  try {
    app.parse(argc, argv);
    if (std::fflush(stdout) != 0)
      throw ppm::OutputError("cannot write to the standard output: " + std::generic_category().message(errno));
    return 0;
  } catch (const CLI::RuntimeError& e) {  // a command that ended early and has said so
    return e.get_exit_code();
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kInputIsWrong;  // --help and --version come this way too
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run_command(argc, argv);
  } catch (const ppm::ConfigError& e) {
    return report(e, kInputIsWrong);
  } catch (const ppm::DataError& e) {
    return report(e, kInputIsWrong);
  } catch (const std::exception& e) {
    return report(e, kFailed);
  }
}
