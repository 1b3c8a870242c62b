#include "host/cli/common/program.h"

#include <fcntl.h>
#include <signal.h>
#include <spherecloud/spherecloud.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <new>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "host/base/usage_error.h"
#include "host/cli/common/exit_code.h"
#include "host/cli/common/option_names.h"

namespace sphc::host {
namespace {

// The list of subcommands shows the first line of each; the rest is for its own help.
class Formatter : public CLI::Formatter {
 public:
  std::string make_subcommand(const CLI::App *sub) const override {
    const std::string all = sub->get_description();
    std::stringstream out;
    CLI::detail::format_help(out, sub->get_name(), all.substr(0, all.find('\n')), get_column_width());
    return out.str();
  }
};

// What the help calls them.
bool takesNames(const CLI::Option &option) {
  static const std::set<std::string> types = {"FILE", "DIR", "FOLDER", "PATH", "MAP", "PNG", "CSV", "CAMERA"};
  return types.count(option.get_type_name()) > 0;
}

// A name that a script left empty must not be taken for "none".
void checkNames(const CLI::App &command) {
  for (const CLI::Option *option : command.get_options()) {
    if (!takesNames(*option)) continue;
    for (const std::string &name : option->results())
      if (name.empty()) throw UsageError(option->get_name() + " is empty; give a name, or leave the option out");
  }
}

int runChosen(const std::vector<Command> &commands, const Console &console) {
  for (const Command &command : commands) {
    if (!command.app->parsed()) continue;
    checkNames(*command.app);
    return command.run(console);
  }
  return kExitUsage;  // unreachable: a subcommand is required
}

int usage(const CLI::App &root, const std::string &why) {
  const auto chosen = root.get_subcommands();
  const std::string name = chosen.empty() ? root.get_name() : root.get_name() + " " + chosen.front()->get_name();
  std::fprintf(stderr, "%s: %s\nTry: %s --help\n", name.c_str(), why.c_str(), name.c_str());
  return kExitUsage;
}

// What was given and nothing takes, in the order in which it was given.
std::vector<std::string> leftOver(const CLI::App &root) {
  const auto chosen = root.get_subcommands();
  std::vector<std::string> words = chosen.empty() ? std::vector<std::string>() : chosen.front()->remaining();
  words.erase(std::remove(words.begin(), words.end(), "--"), words.end());
  return words;
}

std::string causeOf(const CLI::ParseError &error, const CLI::App &root) {
  const std::vector<std::string> words = leftOver(root);
  const int code = error.get_exit_code();
  // A name that was misspelt would be told as one that is missing, and a value before its option.
  const bool is_of_words = code == static_cast<int>(CLI::ExitCodes::ExtrasError) ||
                           code == static_cast<int>(CLI::ExitCodes::RequiredError);
  if (!is_of_words || words.empty()) return error.what();
  const bool is_file = words[0][0] == '-' && std::filesystem::exists(words[0]);
  return "not expected: " + CLI::detail::join(words, " ") +
         (is_file ? "; write the file's name as ./" + words[0] : std::string());
}

int parseAndRun(const Program &program, int argc, char **argv) {
  CLI::App root(program.about, program.name);
  const auto formatter = std::make_shared<Formatter>();
  formatter->column_width(32);
  root.formatter(formatter);
  root.set_version_flag("--version", std::string(program.name) + " " + sphc_version_string());
  root.require_subcommand(1);
  root.footer(program.footer);
  Console console;
  const std::vector<Command> commands = program.declare(&root);
  for (const Command &command : commands)
    command.app->add_flag("--json", console.json, "Result as JSON on stdout, nothing else there");
  try {
    root.parse(argc, argv);
  } catch (const CLI::ParseError &error) {
    if (error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success)) {
      const int status = root.exit(error);  // --help, --version
      Console::checkOutput();
      return status;
    }
    const bool is_unknown = root.get_subcommands().empty() && argc > 1 && argv[1][0] != '-';
    return usage(root, is_unknown ? std::string("there is no subcommand ") + argv[1] : causeOf(error, root));
  }
  try {
    return runChosen(commands, console);
  } catch (const UsageError &error) {
    return usage(root, error.what());
  } catch (const ArgumentError &error) {
    const std::string text = withOptionNames(error.what(), *root.get_subcommands().front());
    if (text != error.what()) return usage(root, text);  // it names an option
    throw;
  } catch (const std::filesystem::filesystem_error &error) {
    throw std::runtime_error(error.path1().string() + ": " + error.code().message() +
                             "; check its name, its permissions and those of its folders");
  } catch (const std::runtime_error &error) {
    throw std::runtime_error(withOptionNames(error.what(), *root.get_subcommands().front()));
  }
}

const char kNoMemory[] = "there is not enough memory; end other programs, or take fewer frames or keypoints";

std::atomic<bool> ran_out_of_memory{false};

// By operator new, or by the last call of the C library that failed.
bool lackedMemory() { return errno == ENOMEM || ran_out_of_memory; }

void noteThatMemoryRanOut() {
  ran_out_of_memory = true;
  throw std::bad_alloc();
}

// Of the exception that ends the program.  One that leaves a destructor cannot be looked at.
bool isOfNoMemory() {
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc &) {
    return true;
  } catch (...) {  // a defect, for a debugger
    return false;
  }
  return lackedMemory();
}

// What was being written has another name than the file, as after a kill.
[[noreturn]] void endWithoutMemory() {
  std::fprintf(stderr, "%s\n", kNoMemory);
  std::_Exit(kExitFailure);
}

// Where an exception cannot go on: destructors of JSON values and of Ceres allocate, and so do threads.
[[noreturn]] void onTerminate() {
  if (!isOfNoMemory()) std::abort();
  endWithoutMemory();
}

struct sigaction before_abort, before_fault;

// A library that got no memory may abort, as Ceres does, or not look at what it got, as CHOLMOD does.  Every other
// crash stays one.
void onCrash(int signal) {
  if (lackedMemory()) endWithoutMemory();
  sigaction(signal, signal == SIGABRT ? &before_abort : &before_fault, nullptr);
}

void catchCrashes() {
  struct sigaction action = {};
  action.sa_handler = onCrash;
  sigaction(SIGABRT, &action, &before_abort);
  sigaction(SIGSEGV, &action, &before_fault);
}

// A file would get the number of an output that whoever started the program closed, and words would go into it.
// What is opened in its place for reading takes none either.
void holdStandardFiles() {
  for (int number : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(number, F_GETFD) < 0) open("/dev/null", O_RDONLY);
}

}  // namespace

int runProgram(const Program &program, int argc, char **argv) {
  holdStandardFiles();
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on sizes of files is then a write that fails, with words
  std::set_new_handler(noteThatMemoryRanOut);
  std::set_terminate(onTerminate);
  catchCrashes();
  try {
    return parseAndRun(program, argc, argv);
  } catch (const std::bad_alloc &) {
    std::fprintf(stderr, "%s: %s\n", program.name, kNoMemory);
  } catch (const std::exception &error) {
    const bool lacked_memory = lackedMemory();  // which may be the cause
    std::fprintf(stderr, "%s: %s\n", program.name, error.what());
    if (lacked_memory) std::fprintf(stderr, "%s\n", kNoMemory);
  } catch (...) {
    std::fprintf(stderr, "%s: an unknown error; please report it with the command line\n", program.name);
  }
  return kExitFailure;
}

}  // namespace sphc::host
