#include "protocol/shared_node.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <utility>

namespace protocol {
namespace {

using Type = SharedLinkFieldType;

/// Queries of one transmission; values, which are as young as their transmission, wait no longer.
constexpr dsp::Seconds longest_asking(1);

std::vector<SharedVariable> variables(const std::vector<std::string>& names) {
  std::vector<SharedVariable> all;
  for (const std::string& name : names) all.push_back({name});
  return all;
}

/// Where in the list; its size if nowhere.
std::size_t place_of(const std::string& name, const std::vector<SharedVariable>& list) {
  const auto at = std::ranges::find(list, name, &SharedVariable::name);
  return static_cast<std::size_t>(at - list.begin());
}

/// A place in a list of so many, or its end.
std::optional<std::size_t> parse_index(const std::string& text, std::size_t size) {
  std::size_t index = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, index);
  if (parsed.ec != std::errc() || parsed.ptr != end || index > size) return std::nullopt;
  return index;
}

std::optional<std::string> problem_in_names(const std::vector<std::string>& names) {
  for (auto name = names.begin(); name != names.end(); ++name) {
    if (name->empty()) return "a variable has no name";
    if (auto problem = problem_in_text(*name)) return "variable \"" + *name + "\": " + *problem;
    if (std::find(names.begin(), name, *name) != name)
      return "variable \"" + *name + "\" is in the list twice";
  }
  return std::nullopt;
}

/// The largest index that a list's value is sent with.
std::string last_index(std::size_t size) { return std::to_string(size == 0 ? 0 : size - 1); }

}  // namespace

/// What a message says, as far as it is known here.
struct SharedNode::Content {
  std::vector<std::pair<std::size_t, std::string>> values;  // inbound variables
  std::vector<std::size_t> replies;                         // those that were asked for by name
  std::vector<std::string> queries;
  std::uint64_t unknown_replies = 0;
};

std::optional<std::string> problem_in_node(const SharedNodeSettings& s) {
  const auto address_text = [](char c) { return std::string{'\'', c, '\''}; };
  for (const char address : {s.address, s.peer})
    if (!is_address(address)) return address_text(address) + " is no address, 'A' to 'P'";
  if (s.address == s.peer) return "the node and its peer have one address, " + address_text(s.peer);
  if (auto problem = problem_in_message({s.peer, s.address, {}}, s.max_size)) return problem;
  if (auto problem = problem_in_names(s.outbound)) return problem;
  if (auto problem = problem_in_names(s.inbound)) return problem;
  for (const auto* names : {&s.outbound, &s.inbound})
    for (const std::string& name : *names)
      if (auto problem = problem_in_message({s.peer, s.address, {{Type::query, name}}}, s.max_size))
        return "variable \"" + name + "\": " + *problem;
  return std::nullopt;
}

SharedNode::SharedNode(SharedNodeSettings settings)
    : settings_(std::move(settings)),
      decoder_(settings_.max_size),
      outbound_(variables(settings_.outbound)),
      inbound_(variables(settings_.inbound)),
      changed_(outbound_.size(), false),
      given_up_(inbound_.size(), false) {
  assert(!problem_in_node(settings_));
}

std::optional<std::string> SharedNode::problem_in_value(std::size_t variable,
                                                        const std::string& value) const {
  if (value.empty()) return "an empty value cannot be sent: it says that nothing has changed";
  SharedLinkMessage alone = to_peer(), reply = to_peer();
  alone.fields = {{Type::index, last_index(outbound_.size())}, {Type::data, value}};
  reply.fields = {{Type::reply, outbound_[variable].name}, {Type::data, value}};
  for (const SharedLinkMessage& message : {alone, reply})
    if (auto problem = problem_in_message(message, settings_.max_size)) return problem;
  return std::nullopt;
}

std::optional<std::string> SharedNode::set(std::size_t variable, const std::string& value) {
  if (auto problem = problem_in_value(variable, value)) return problem;
  changed_[variable] = changed_[variable] || outbound_[variable].value != value;
  outbound_[variable].value = value;
  return std::nullopt;
}

void SharedNode::ask(std::size_t variable) {
  if (std::ranges::find(to_ask_, variable) == to_ask_.end()) to_ask_.push_back(variable);
}

Bytes SharedNode::transmit(dsp::Seconds now) {
  give_up(now);
  Bytes bytes;
  append_answers(bytes);
  append_queries(bytes, now);
  const bool full =
      !settings_.compressed || !full_set_at_ || now - *full_set_at_ >= settings_.full_set_every;
  append_values(bytes, full);
  if (full) full_set_at_ = now;
  return bytes;
}

void SharedNode::append(Bytes& bytes, const SharedLinkMessage& message) {
  const Bytes more = shared_link_encode(message);
  bytes.insert(bytes.end(), more.begin(), more.end());
  ++counts_.sent;
}

void SharedNode::append_answers(Bytes& bytes) {
  for (const std::size_t variable : std::exchange(to_answer_, {})) {
    SharedLinkMessage message = to_peer();
    message.fields = {{Type::reply, outbound_[variable].name},
                      {Type::data, outbound_[variable].value}};
    append(bytes, message);
  }
}

void SharedNode::append_queries(Bytes& bytes, dsp::Seconds now) {
  const auto time_of = [&](std::size_t n) { return static_cast<double>(n) * settings_.byte_time; };
  const std::size_t from = bytes.size();
  auto next = to_ask_.begin();
  for (; next != to_ask_.end() && time_of(bytes.size() - from) < longest_asking; ++next) {
    SharedLinkMessage message = to_peer();
    message.fields = {{Type::query, inbound_[*next].name}};
    append(bytes, message);
    if (std::ranges::find(asked_, *next, &Query::variable) != asked_.end()) continue;
    asked_.push_back({*next, now + time_of(bytes.size())});
    given_up_[*next] = false;
    ++counts_.asked;
  }
  to_ask_.erase(to_ask_.begin(), next);
}

/// As many values to a message as fit, from one that is to be sent to another.
void SharedNode::append_values(Bytes& bytes, bool full) {
  const auto text = [&](std::size_t i) { return full || changed_[i] ? outbound_[i].value : ""; };
  for (std::size_t i = 0; i < outbound_.size();) {
    if (text(i).empty()) {
      ++i;
      continue;
    }
    SharedLinkMessage message = to_peer();
    message.fields = {{Type::index, std::to_string(i)}};
    std::size_t end = i;  // behind the last one that says something
    for (std::size_t next = i; next < outbound_.size(); ++next) {
      message.fields.push_back({Type::data, text(next)});
      if (shared_link_size(message) > settings_.max_size) break;
      if (!text(next).empty()) end = next + 1;
    }
    message.fields.resize(1 + end - i);
    append(bytes, message);
    i = end;
  }
  changed_.assign(changed_.size(), false);
}

std::vector<std::size_t> SharedNode::give_up(dsp::Seconds now) {
  const auto is_late = [&](const Query& q) { return now - q.since >= settings_.query_timeout; };
  std::vector<std::size_t> late;
  for (const Query& query : asked_)
    if (is_late(query)) late.push_back(query.variable);
  std::erase_if(asked_, is_late);
  for (const std::size_t variable : late) given_up_[variable] = true;
  counts_.timed_out += late.size();
  return late;
}

SharedNodeNews SharedNode::receive(const UartByte& byte) {
  give_up(byte.start);
  SharedNodeNews news;
  auto frame = decoder_.push(byte);
  if (!frame) return news;
  news.text = std::move(frame->text);
  if (frame->outcome != SharedLinkOutcome::ok)
    ++counts_.rejected[static_cast<std::size_t>(frame->outcome)];
  else if (const auto content = content_of(frame->message))
    take(*content, byte.start, news);
  return news;
}

/// Reads the fields of a message one by one; what makes no sense it counts.
class SharedNode::ContentReader {
 public:
  ContentReader(const std::vector<SharedVariable>& inbound, SharedNodeCounts& counts)
      : inbound_(inbound), counts_(counts) {}

  /// Whether the message may go on.
  bool read(const SharedLinkField& field) {
    if (reply_ && field.type != Type::data) return refuse(counts_.misplaced);
    switch (field.type) {
      case Type::index:
        index_ = parse_index(field.text, inbound_.size());
        return index_ || refuse(counts_.bad_index);
      case Type::data:
        return reply_ ? read_reply(field.text) : read_value(field.text);
      case Type::query:
        content_.queries.push_back(field.text);
        return true;
      case Type::reply:
        reply_ = field.text;
        return true;
    }
    return false;
  }
  /// Of a message that has ended here.
  std::optional<Content> content() {
    if (reply_ && !refuse(counts_.misplaced)) return std::nullopt;
    return std::move(content_);
  }

 private:
  static bool refuse(std::uint64_t& count) {
    ++count;
    return false;
  }
  bool read_reply(const std::string& value) {
    const std::size_t variable = place_of(*std::exchange(reply_, {}), inbound_);
    if (variable == inbound_.size()) {
      ++content_.unknown_replies;
    } else {
      content_.values.emplace_back(variable, value);
      content_.replies.push_back(variable);
    }
    return true;
  }
  bool read_value(const std::string& value) {
    if (!index_) return refuse(counts_.misplaced);
    if (*index_ >= inbound_.size()) return refuse(counts_.bad_index);
    content_.values.emplace_back((*index_)++, value);
    return true;
  }

  const std::vector<SharedVariable>& inbound_;
  SharedNodeCounts& counts_;
  Content content_;
  std::optional<std::size_t> index_;  // of the next value
  std::optional<std::string> reply_;  // whose value is next
};

/// Nothing, and it is counted, where the message is not for this node or makes no sense.
std::optional<SharedNode::Content> SharedNode::content_of(const SharedLinkMessage& message) {
  std::uint64_t* const strange = message.source == settings_.address        ? &counts_.from_self
                                 : message.destination != settings_.address ? &counts_.for_others
                                 : message.source != settings_.peer         ? &counts_.from_others
                                                                            : nullptr;
  if (strange != nullptr) {
    ++*strange;
    return std::nullopt;
  }
  ContentReader reader(inbound_, counts_);
  for (const SharedLinkField& field : message.fields)
    if (!reader.read(field)) return std::nullopt;
  return reader.content();
}

void SharedNode::take(const Content& content, dsp::Seconds now, SharedNodeNews& news) {
  ++counts_.accepted;
  counts_.unknown_replies += content.unknown_replies;
  for (const auto& [variable, value] : content.values) {
    if (value.empty()) continue;
    SharedVariable& mine = inbound_[variable];
    mine.at = now;
    if (std::exchange(mine.value, value) != value) news.changed.push_back(variable);
  }
  for (const std::size_t variable : content.replies) take_reply(variable, now, news);
  counts_.answered += news.answered.size();
  counts_.answered_late += news.late.size();
  answer(content.queries);
}

/// The peer goes on to the queries behind this one only now.
void SharedNode::take_reply(std::size_t variable, dsp::Seconds now, SharedNodeNews& news) {
  if (given_up_[variable]) news.late.push_back(variable);
  given_up_[variable] = false;
  const auto query = std::ranges::find(asked_, variable, &Query::variable);
  if (query == asked_.end()) return;
  news.answered.push_back(variable);
  auto behind = asked_.erase(query);
  if (settings_.byte_time == dsp::Seconds(0)) return;
  for (; behind != asked_.end(); ++behind) behind->since = std::max(behind->since, now);
}

/// Each once with what is sent next, however often it was asked for.
void SharedNode::answer(const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const std::size_t variable = place_of(name, outbound_);
    if (variable == outbound_.size() || outbound_[variable].value.empty())
      ++counts_.unknown_asked;
    else if (std::ranges::find(to_answer_, variable) == to_answer_.end())
      to_answer_.push_back(variable);
  }
}

}  // namespace protocol
