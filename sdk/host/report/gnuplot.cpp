#include "host/report/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <filesystem>
#include <new>

#include "host/base/write_file.h"

extern char **environ;

namespace sphc::host {

const char kPlotHead[] = "# drawn by spherecloud\n";

namespace {

std::string terminals(const std::string &name, const std::string &script, PlotSize size) {
  const std::string box = std::to_string(size.width_px) + "," + std::to_string(size.height_px);
  const std::string large = std::to_string(2 * size.width_px) + "," + std::to_string(2 * size.height_px);
  return std::string(kPlotHead) + "set terminal svg size " + box +
         " dynamic font 'Helvetica,Arial,sans-serif,13' background '#ffffff'\n" + "set output '" + name +
         ".svg'\n" + script + "\nset terminal pngcairo size " + large +
         " font 'Sans,13' fontscale 1.6 linewidth 1.8 pointscale 1.6 background '#ffffff'\n" + "set output '" +
         name + ".png'\nreplot\n";
}

// True when gnuplot could be started; *exit_status as of waitpid.
bool runGnuplot(const std::string &folder, const std::string &script_name, int *exit_status) {
  posix_spawn_file_actions_t actions;
  const bool is_told =
      posix_spawn_file_actions_init(&actions) == 0 &&
      posix_spawn_file_actions_addchdir_np(&actions, folder.c_str()) == 0 &&
      posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0) == 0 &&
      posix_spawn_file_actions_addopen(&actions, 1, "gnuplot.log", O_WRONLY | O_CREAT | O_APPEND, 0644) == 0 &&
      posix_spawn_file_actions_adddup2(&actions, 1, 2) == 0;
  if (!is_told) throw std::bad_alloc();
  std::string program = "gnuplot", argument = script_name;
  char *arguments[] = {program.data(), argument.data(), nullptr};
  pid_t child = 0;
  const int failure = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) return false;
  while (waitpid(child, exit_status, 0) < 0) {
    if (errno != EINTR) return false;
  }
  return true;
}

void removeEmpty(const std::string &path) {
  std::error_code error;
  if (std::filesystem::file_size(path, error) == 0 && !error) std::filesystem::remove(path, error);
}

}  // namespace

const char kPlotLook[] =
    "set border 3 linecolor rgb '#94a3b8'\n"
    "set tics nomirror textcolor rgb '#475569'\n"
    "set xlabel textcolor rgb '#334155'\n"
    "set ylabel textcolor rgb '#334155'\n"
    "set grid linecolor rgb '#e2e8f0' linewidth 1\n"
    "set key textcolor rgb '#334155'\n";

void removePlot(const std::string &folder, const std::string &name) {
  for (const char *ending : {".gp", ".svg", ".png"}) std::filesystem::remove(folder + "/" + name + ending);
}

PlotResult plot(const std::string &folder, const std::string &name, const std::string &script, PlotSize size) {
  removePlot(folder, name);  // of another run
  writeFile(folder + "/" + name + ".gp", terminals(name, script, size));
  int status = 0;
  const bool was_run = runGnuplot(folder, name + ".gp", &status);
  removeEmpty(folder + "/gnuplot.log");
  if (!was_run || (WIFEXITED(status) && WEXITSTATUS(status) == 127)) return PlotResult::kNoGnuplot;
  const bool done =
      WIFEXITED(status) && WEXITSTATUS(status) == 0 && std::filesystem::exists(folder + "/" + name + ".svg");
  return done ? PlotResult::kDone : PlotResult::kFailed;
}

}  // namespace sphc::host
