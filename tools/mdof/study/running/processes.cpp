#include "tools/mdof/study/running/processes.h"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "daemon/words/error_text.h"
#include "tools/mdof/exit_code.h"
#include "tools/mdof_mpi/mdof_mpi.h"

namespace mdof::tools {
namespace {

constexpr const char* kModule = "mdof_mpi.so";

// Whether MPI started this process. The variables are set by Open MPI, by MPICH and Slurm (PMI),
// and by other launchers (PMIx).
bool started_by_mpi() {
  constexpr std::array names = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_RANK"};
  for (const char* name : names)
    if (std::getenv(name)) return true;
  return false;
}

using Start = const MdofMpi* (*)();

Result<Start> load_module() {
  std::error_code ec;
  const auto file = std::filesystem::read_symlink("/proc/self/exe", ec).parent_path() / kModule;
  // RTLD_GLOBAL is necessary, because the plug-ins of Open MPI use the symbols of the library.
  void* const module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  void* const start = module ? ::dlsym(module, "mdof_mpi_start") : nullptr;
  if (start) return reinterpret_cast<Start>(start);
  return io_error("mdof was started by MPI, but the MPI module cannot be loaded (" +
                  std::string(::dlerror()) +
                  "), so every process would calculate the whole study; build mdof with "
                  "-DMDOF_MPI=ON and the MPI library installed, or start mdof without mpirun");
}

}  // namespace

// Runs if this process ends after an error without leave(). Ends the other processes, which would
// otherwise wait forever.
void Processes::AbortAll::operator()(const MdofMpi* mpi) const {
  mpi->abort(kDeviceOrIo);
}

Result<Processes> Processes::join() {
  Processes processes;
  if (!started_by_mpi()) return processes;
  MDOF_TRY(const Start start, load_module());
  processes.mpi_.reset(start());
  if (!processes.mpi_)
    return io_error("MPI cannot be started; check that this command works: mpirun -n 1 hostname");
  return processes;
}

int Processes::rank() const {
  return mpi_ ? mpi_->rank : 0;
}

int Processes::size() const {
  return mpi_ ? mpi_->size : 1;
}

std::uint64_t Processes::broadcast_number(std::uint64_t x) {
  std::array<char, sizeof x> bytes;
  std::memcpy(bytes.data(), &x, sizeof x);
  if (mpi_) mpi_->broadcast(bytes.data(), bytes.size());
  std::memcpy(&x, bytes.data(), sizeof x);
  return x;
}

std::string Processes::broadcast(std::string bytes) {
  bytes.resize(broadcast_number(bytes.size()));
  if (mpi_) mpi_->broadcast(bytes.data(), bytes.size());
  return bytes;
}

bool Processes::any(bool mine) {
  if (!first()) send(0, mine ? "1" : "0");
  if (first()) {
    for (int from = 1; from < size(); ++from) mine = receive(from) == "1" || mine;
  }
  return broadcast_number(mine ? 1 : 0) == 1;
}

void Processes::send(int to, std::string_view bytes) {
  mpi_->send(to, bytes.data(), bytes.size());
}

std::string Processes::receive(int from) {
  std::string bytes(mpi_->incoming(from), '\0');
  mpi_->receive(from, bytes.data(), bytes.size());
  return bytes;
}

Status Processes::agree(const Status& mine) {
  if (size() == 1) return mine;
  Status all = mine;
  if (!first()) send(0, mine ? std::string() : words::text(mine.error()));
  if (first()) {
    for (int from = 1; from < size(); ++from) {
      const std::string message = receive(from);
      if (!message.empty() && all)
        all = io_error("process " + std::to_string(from) + ": " + message);
    }
  }
  if (broadcast_number(all ? 1 : 0) == 1) return {};
  return first() ? all : io_error("another process of the study failed");
}

void Processes::leave() {
  if (mpi_) mpi_.release()->finish();
}

}  // namespace mdof::tools
