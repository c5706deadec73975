// What a person types after a program's name. A narrow front of CLI11, whose headers cost every
// file that includes them some ten seconds: options.cpp alone does.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace arcstart {

// An option or a flag of a command, to say more of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}
  Option& required();
  Option& show_default();
  Option& for_scripts();  // its own group in --help
  Option& one_of(const std::vector<std::string>& choices);
  Option& between(int low, int high);
  Option& between(double low, double high);
  Option& positive();
  Option& existing_file();
  Option& existing_folder();
  Option& existing_path();
  // of three numbers, x,y,z
  Option& vector();
  // check: why a text cannot be its value, empty where it can.
  Option& check(const std::function<std::string(const std::string& text)>& check);
  Option& excludes(const std::vector<std::string>& names);

 private:
  CLI::Option* option_;
};

// A command's options. What they are read into must outlive the reading.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}
  Command(CLI::App& parent, const std::string& name, const std::string& purpose);  // a subcommand
  Command(Command& parent, const std::string& name, const std::string& purpose);   // one of those

  // name: "--cell", "-o,--output", or without hyphens for one that is known by its place.
  Option option(const std::string& name, std::string& value, const std::string& purpose);
  Option option(const std::string& name, int& value, const std::string& purpose);
  Option option(const std::string& name, std::int64_t& value, const std::string& purpose);
  Option option(const std::string& name, double& value, const std::string& purpose);
  Option option(const std::string& name, std::vector<std::string>& value,
                const std::string& purpose);
  Option option(const std::string& name, std::vector<double>& value, const std::string& purpose);
  Option flag(const std::string& name, bool& value, const std::string& purpose);
  void footer(const std::string& text);
  void require_command();                       // one of its subcommands must be given
  void run(const std::function<void()>& work);  // when all is read

  // In run(): the value of this option cannot be. Throws what the program takes for bad input.
  [[noreturn]] static void refuse(const std::string& option, const std::string& why);

 protected:
  CLI::App* app_;
};

// The whole command line.
class Program : public Command {
 public:
  explicit Program(const std::string& purpose);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  CLI::App& app() { return *app_; }  // for its subcommands
  void version(const std::string& version);
  std::string command() const;  // that was typed, "import scan"; empty where there is none

  // The code to exit with, 0 or 2, where --help, --version or a mistake ends the program here.
  std::optional<int> parse(int argc, char** argv);

 private:
  std::unique_ptr<CLI::App> owned_;
};

}  // namespace arcstart
