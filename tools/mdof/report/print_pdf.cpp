#include "tools/mdof/report/print_pdf.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "schema/base/output/output_files.h"
#include "tools/mdof/find_program.h"
#include "tools/mdof/output.h"
#include "tools/mdof/progress_bar.h"

namespace mdof::tools {

namespace fs = std::filesystem;

namespace {

constexpr std::chrono::seconds kLongestPrint{120};

// Runs a program and returns its exit status. The output of the program is discarded; a missing PDF
// file shows that the program has failed.
Result<int> run_program(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  ::posix_spawn_file_actions_init(&actions);
  for (const int descriptor : {0, 1, 2})
    ::posix_spawn_file_actions_addopen(&actions, descriptor, "/dev/null", O_RDWR, 0);
  pid_t child = 0;
  const int failed =
      ::posix_spawn(&child, words.front().c_str(), &actions, nullptr, arguments.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  if (failed != 0) return io_error(words.front() + ": cannot be started: " + std::strerror(failed));
  ProgressBar waiting(fs::path(words.front()).filename().string() + " writes the PDF");
  const auto last = std::chrono::steady_clock::now() + kLongestPrint;
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(child, &status, WNOHANG);
    if (ended == child) return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    if (ended < 0 && errno != EINTR)
      return io_error(words.front() +
                      ": cannot wait for the end of the program: " + std::strerror(errno));
    if (std::chrono::steady_clock::now() > last) {
      ::kill(child, SIGKILL);
      ::waitpid(child, &status, 0);
      return io_error(words.front() + ": the program did not finish within " +
                      std::to_string(kLongestPrint.count()) + " s, so mdof stopped this program");
    }
    waiting.show_elapsed();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// Percent-encodes the path, so that special characters in a file name have no effect.
std::string file_url(const fs::path& file) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789/_.-~";
  std::string url = "file://";
  for (const char c : fs::absolute(file).string()) {
    const auto byte = static_cast<unsigned char>(c);
    if (kPlain.find(c) != std::string_view::npos)
      url += c;
    else
      url += {'%', kDigits[byte >> 4], kDigits[byte & 15]};
  }
  return url;
}

Result<std::vector<std::string>> command_for(const fs::path& html, const fs::path& pdf) {
  if (const auto chromium = find_program("chromium")) {
    std::vector<std::string> words = {chromium->string(),
                                      "--headless",
                                      "--disable-gpu",
                                      "--no-pdf-header-footer",
                                      "--print-to-pdf=" + fs::absolute(pdf).string(),
                                      file_url(html)};
    // chromium does not run as root with its sandbox. The page needs no sandbox, because it
    // contains no script and loads no other files.
    if (::geteuid() == 0) words.insert(words.begin() + 1, "--no-sandbox");
    return words;
  }
  if (const auto weasyprint = find_program("weasyprint"))
    return std::vector<std::string>{weasyprint->string(), file_url(html),
                                    fs::absolute(pdf).string()};
  return io_error(
      "no program that writes PDF is installed; install chromium or weasyprint (sudo apt install "
      "chromium, or sudo apt install weasyprint), or open " +
      html.string() + " in a browser and print the report");
}

}  // namespace

Status print_pdf(const fs::path& html, const fs::path& pdf) {
  MDOF_TRY(const auto words, command_for(html, pdf));
  std::error_code ec;
  fs::remove(pdf, ec);
  MDOF_TRY(const int status, run_program(words));
  if (status == 0 && fs::file_size(pdf, ec) > 0 && !ec) return {};
  return io_error(pdf.string() + ": " + words.front() + " did not write this file (exit status " +
                  std::to_string(status) + "); open " + html.string() +
                  " in a browser and print the report");
}

Status attach_to_pdf(const fs::path& pdf, const std::string& name, const std::string& media_type,
                     const std::string& bytes) {
  const auto qpdf = find_program("qpdf");
  if (!qpdf) {
    say(pdf.string() + " does not contain " + name +
        ", because qpdf is not installed; install qpdf (sudo apt install qpdf), or send the HTML "
        "file, which contains " +
        name);
    return {};
  }
  std::error_code ec;
  // The temporary folder is in the folder of the PDF; a rename then replaces the PDF completely or
  // not at all.
  std::string folder = (fs::absolute(pdf).parent_path() / "mdof-pdf-XXXXXX").string();
  if (::mkdtemp(folder.data()) == nullptr)
    return io_error(folder + ": cannot be created: " + std::strerror(errno));
  const fs::path file = fs::path(folder) / name, both = fs::path(folder) / "both.pdf";
  const std::string without =
      "; the PDF file contains only the report. Send the HTML file, which contains " + name;
  Status done = write_file(file.string(), bytes, Existing::replace);
  if (done) {
    const auto status =
        run_program({qpdf->string(), fs::absolute(pdf).string(), "--add-attachment", file.string(),
                     "--mimetype=" + media_type, "--", both.string()});
    if (!status) {
      done = tl::unexpected(status.error());
    } else if (*status != 0) {
      done = io_error(pdf.string() + ": qpdf did not attach " + name + " (exit status " +
                      std::to_string(*status) + ")" + without);
    } else if (fs::rename(both, pdf, ec); ec) {
      done = io_error(pdf.string() + ": " + name + " is not attached, because " + both.string() +
                      " could not be renamed: " + ec.message() + without);
    }
  }
  fs::remove_all(folder, ec);
  return done;
}

}  // namespace mdof::tools
