#include "common/options.hpp"

#include <CLI/CLI.hpp>

namespace arcstart {

Option& Option::required() {
  option_->required();
  return *this;
}
Option& Option::show_default() {
  option_->capture_default_str();
  return *this;
}
Option& Option::for_scripts() {
  option_->group("For scripts");
  return *this;
}
Option& Option::one_of(const std::vector<std::string>& choices) {
  option_->check(CLI::IsMember(choices));
  return *this;
}
Option& Option::between(int low, int high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
Option& Option::between(double low, double high) {
  option_->check(CLI::Range(low, high));
  return *this;
}
Option& Option::positive() {
  option_->check(CLI::PositiveNumber);
  return *this;
}
Option& Option::existing_file() {
  option_->check(CLI::ExistingFile);
  return *this;
}
Option& Option::existing_folder() {
  option_->check(CLI::ExistingDirectory);
  return *this;
}
Option& Option::existing_path() {
  option_->check(CLI::ExistingPath);
  return *this;
}
Option& Option::vector() {
  option_->delimiter(',')->expected(3);
  return *this;
}
Option& Option::check(const std::function<std::string(const std::string&)>& check) {
  option_->check(check);
  return *this;
}
Option& Option::excludes(const std::vector<std::string>& names) {
  for (const std::string& name : names) option_->excludes(name);
  return *this;
}

Command::Command(CLI::App& parent, const std::string& name, const std::string& purpose)
    : app_(parent.add_subcommand(name, purpose)) {}
Command::Command(Command& parent, const std::string& name, const std::string& purpose)
    : Command(*parent.app_, name, purpose) {}

Option Command::option(const std::string& name, std::string& value, const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::option(const std::string& name, int& value, const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::option(const std::string& name, std::int64_t& value, const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::option(const std::string& name, double& value, const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::option(const std::string& name, std::vector<std::string>& value,
                       const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::option(const std::string& name, std::vector<double>& value,
                       const std::string& purpose) {
  return Option(*app_->add_option(name, value, purpose));
}
Option Command::flag(const std::string& name, bool& value, const std::string& purpose) {
  return Option(*app_->add_flag(name, value, purpose));
}
void Command::footer(const std::string& text) { app_->footer(text); }
void Command::require_command() { app_->require_subcommand(1); }
void Command::run(const std::function<void()>& work) { app_->callback(work); }

void Command::refuse(const std::string& option, const std::string& why) {
  throw CLI::ValidationError(option, why);
}

Program::Program(const std::string& purpose) : Command(*new CLI::App(purpose)), owned_(app_) {}
Program::~Program() = default;

void Program::version(const std::string& version) { app_->set_version_flag("--version", version); }

std::string Program::command() const {
  std::string typed;
  for (auto commands = app_->get_subcommands(); !commands.empty();
       commands = commands.front()->get_subcommands())
    typed += (typed.empty() ? "" : " ") + commands.front()->get_name();
  return typed;
}

std::optional<int> Program::parse(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::ParseError& error) {
    return app_->exit(error) == 0 ? 0 : 2;
  }
}

}  // namespace arcstart
