#include "sim/result/reading_process.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <memory>
#include <utility>

#include "sim/failure.hpp"
#include "sim/result/hdf5_answers.hpp"

namespace sim {
namespace {

constexpr int patience_s = 6;
constexpr int slice_ms = 100;      // of patience: while we are stopped ourselves none is used up
constexpr double processor_s = 1;  // a result of ours takes a hundredth
constexpr std::size_t bytes_a_second = std::size_t{16} << 20U;  // a tenth of what gzip unpacks
constexpr rlim_t room_bytes = rlim_t{640} << 20U;
constexpr std::size_t longest_name_asked = 4096;
constexpr std::size_t short_answer = 65536;  // goes in one piece

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool is_sanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
constexpr bool is_sanitized = true;
#else
constexpr bool is_sanitized = false;
#endif
#else
constexpr bool is_sanitized = false;
#endif

// ---- what goes over the socket; both ends are of one program ----

struct QuestionHead {
  Asked what;
  std::uint64_t name_bytes, first, count;
};

struct AnswerHead {
  std::uint64_t is_refused, bytes;
};

template <class Head>
void append_head(std::string& to, const Head& head) {
  to.append(reinterpret_cast<const char*>(&head), sizeof head);
}

bool send_all(int socket, const std::string& bytes) {
  for (std::size_t sent = 0; sent < bytes.size();) {
    const ssize_t n = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
    if (n < 0 && errno != EINTR) return false;
    if (n > 0) sent += static_cast<std::size_t>(n);
  }
  return true;
}

bool send_question(int socket, const Question& question) {
  std::string bytes;
  append_head(bytes,
              QuestionHead{question.what, question.name.size(), question.first, question.count});
  return send_all(socket, bytes + question.name);
}

// ---- the child ----

/// False at the end: who asks is gone.
bool take(int socket, void* to, std::size_t bytes) {
  auto* place = static_cast<char*>(to);
  while (bytes > 0) {
    const ssize_t n = ::read(socket, place, bytes);
    if (n == 0 || (n < 0 && errno != EINTR)) return false;
    if (n < 0) continue;
    place += n;
    bytes -= static_cast<std::size_t>(n);
  }
  return true;
}

bool take_question(int socket, Question& question) {
  QuestionHead head;
  if (!take(socket, &head, sizeof head)) return false;
  question = {head.what, std::string(head.name_bytes, '\0'), head.first, head.count};
  return take(socket, question.name.data(), question.name.size());
}

/// More processor time, counted from now on; at its end a signal kills the process.
void allow(double seconds) {
  itimerval left{};
  ::getitimer(ITIMER_PROF, &left);
  seconds +=
      static_cast<double>(left.it_value.tv_sec) + 1e-6 * static_cast<double>(left.it_value.tv_usec);
  left.it_value.tv_sec = static_cast<time_t>(seconds);
  left.it_value.tv_usec =
      static_cast<suseconds_t>(1e6 * (seconds - static_cast<double>(left.it_value.tv_sec)));
  ::setitimer(ITIMER_PROF, &left, nullptr);
}

void limit_memory() {
  rlim_t pages = 0;
  if (is_sanitized) return;  // its shadow takes all addresses at once
  if (!(std::ifstream("/proc/self/statm") >> pages)) return;
  const rlim_t most = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + room_bytes;
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
}

/// A fall of the library says no word on the terminal. What a sanitizer finds in code of ours it
/// tells: its traps are SIGILL.
void fall_in_silence(int nowhere) {
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT, SIGPROF}) std::signal(fatal, SIG_DFL);
  if (is_sanitized) return;
  std::signal(SIGILL, SIG_DFL);
  ::dup2(nowhere, STDERR_FILENO);
}

/// What is open here stays as it is, and a fall leaves no core. Who stops the program with the
/// keyboard stops us by going away.
void keep_apart() {
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  ::dup2(nowhere, STDOUT_FILENO);
  fall_in_silence(nowhere);
  for (const int wish : {SIGINT, SIGTERM, SIGHUP}) std::signal(wish, SIG_IGN);
  sigset_t none;
  ::sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  limit_memory();
  ::prctl(PR_SET_DUMPABLE, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a fallen library may not come back to the socket
  allow(processor_s);
}

/// None where the library refuses in order, or has no room.
template <class Get>
auto unless_refused(const Get& get) -> std::optional<decltype(get())> {
  try {
    return get();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

bool send_answer(int socket, const std::optional<std::string>& answer) {
  const bool is_refused = !answer || answer->size() > most_answer_bytes;
  std::string head;
  append_head(head, AnswerHead{is_refused ? 1U : 0U, is_refused ? 0 : answer->size()});
  if (is_refused) return send_all(socket, head);
  if (answer->size() <= short_answer) return send_all(socket, head + *answer);
  return send_all(socket, head) && send_all(socket, *answer);
}

[[noreturn]] void answer_until_end(int socket, const std::filesystem::path& path) {
  keep_apart();
  const auto file = unless_refused([&] { return std::make_unique<Hdf5Answers>(path); });
  Question question;
  while (take_question(socket, question)) {
    std::optional<std::string> answer;
    if (file) answer = unless_refused([&] { return (*file)->answer(question); });
    if (!send_answer(socket, answer)) break;
    if (answer) allow(static_cast<double>(answer->size()) / static_cast<double>(bytes_a_second));
  }
  ::_exit(0);
}

Failure no_process(const std::string& path, int error) {
  return {ExitCode::environment, "cannot read " + path + " in a process of its own (" +
                                     std::strerror(error) + ") end other programs"};
}

std::string fault_of(int status) {
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGPROF)
    return "damaged: reading it comes to no end";
  return "damaged: the HDF5 library falls over it";
}

}  // namespace

ReadingProcess::ReadingProcess(const std::filesystem::path& path) : path_(path.string()) {
  int ends[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw no_process(path_, errno);
  child_ = ::fork();
  const int error = errno;
  if (child_ == 0) {
    ::close(ends[0]);
    answer_until_end(ends[1], path);
  }
  ::close(ends[1]);
  socket_ = ends[0];
  if (child_ > 0) return;
  ::close(socket_);
  throw no_process(path_, error);
}

ReadingProcess::~ReadingProcess() { wait_for_end(); }

/// Without its questions it ends by itself. A younger one has our end of the socket too, so it does
/// not do to close that.
int ReadingProcess::wait_for_end() {
  if (socket_ >= 0) {
    ::shutdown(socket_, SHUT_RDWR);
    ::close(std::exchange(socket_, -1));
  }
  int status = 0;
  if (child_ > 0)
    while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) continue;
  child_ = -1;
  return status;
}

ReadingProcess::Received ReadingProcess::receive(void* to, std::size_t bytes) const {
  auto* place = static_cast<char*>(to);
  for (int slices = patience_s * 1000 / slice_ms; bytes > 0 && slices > 0;) {
    const ssize_t n = ::recv(socket_, place, bytes, MSG_DONTWAIT);
    if (n > 0) {
      place += n;
      bytes -= static_cast<std::size_t>(n);
    } else if (n < 0 && errno == EAGAIN) {
      pollfd wait{socket_, POLLIN, 0};
      if (::poll(&wait, 1, slice_ms) == 0) --slices;
    } else if (n == 0 || errno != EINTR) {
      return Received::end;
    }
  }
  return bytes == 0 ? Received::all : Received::nothing;
}

/// Kills it only where it is known to be there: where whoever started us has its children reaped,
/// its number may be another's by now.
void ReadingProcess::give_up(Received last) {
  if (last == Received::nothing) {
    ::kill(child_, SIGKILL);
    wait_for_end();
    fault_ = "no answer within " + std::to_string(patience_s) +
             " s: damaged, or on a disk that does not answer";
  } else {
    fault_ = fault_of(wait_for_end());
  }
  throw bad_input(path_, fault_, "choose another file");
}

std::optional<std::string> ReadingProcess::ask(const Question& question) {
  if (!fault_.empty()) throw bad_input(path_, fault_, "choose another file");
  if (question.name.size() > longest_name_asked) return std::nullopt;
  if (!send_question(socket_, question)) give_up(Received::end);
  AnswerHead head{};
  if (const Received got = receive(&head, sizeof head); got != Received::all) give_up(got);
  if (head.is_refused != 0) return std::nullopt;
  if (head.bytes > most_answer_bytes) give_up(Received::end);
  std::string answer(head.bytes, '\0');
  if (const Received got = receive(answer.data(), answer.size()); got != Received::all)
    give_up(got);
  return answer;
}

}  // namespace sim
