#include "common/bus/bus.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/resource.h>

#include <cctype>

#include "common/host/host_resources.hpp"

namespace arcstart {
namespace {

// LCM takes channels as regular expressions: a plain name must match itself alone.
std::string escaped(const std::string& channel) {
  std::string pattern;
  for (const char character : channel) {
    if (!std::isalnum(static_cast<unsigned char>(character)) && character != '_') pattern += '\\';
    pattern += character;
  }
  return pattern;
}

// LCM never says how large its socket's buffer became: a socket of our own tells what the kernel
// grants.
std::string buffer_shortfall(int wanted) {
  const int granted = granted_receive_buffer(wanted);
  if (granted >= wanted) return "";
  return fmt::format(
      "receive buffer is {} of the {} bytes asked for, images will be lost: run scripts/setup, or "
      "'sysctl -w net.core.rmem_max={}' as root, on the host and not in a container",
      granted, wanted, wanted);
}

// LCM says of none of its failures what it was. Services start where they may open 12 files in all,
// of which three are the standard ones, and do not with 8 (tried).
constexpr rlim_t kDescriptors = 9;

// How many more files this process may open; no more than asked for are counted.
rlim_t free_descriptors(rlim_t asked) {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  rlim_t left = 0;
  for (rlim_t one = 0; one < limit.rlim_cur && left < asked; ++one)
    if (fcntl(static_cast<int>(one), F_GETFD) < 0) ++left;
  return left;
}

}  // namespace

struct Bus::Subscription {
  Bus* bus;
  std::string pattern;
  Queue limits;
  std::function<void(const Bytes&, const std::string&)> handler;
  std::size_t messages = 0, bytes = 0;  // that wait now, under the bus's mutex
};

struct Bus::Transport {
  lcm::LCM lcm;
  bool in_memory;
  std::atomic<bool> ending{false};
  std::thread receiver;  // begins with the first handle(), so that subscriptions need no lock

  Transport(const std::string& url, bool memory) : lcm(url), in_memory(memory) {}
};

Bus::Bus() = default;

std::vector<std::string> BusSettings::urls() const {
  const auto url = [this](int of_port) {
    return fmt::format("udpm://{}:{}?ttl={}&recv_buf_size={}", group, of_port, ttl,
                       receive_buffer_bytes);
  };
  if (image_port == 0 || image_port == port) return {url(port)};
  return {url(port), url(image_port)};
}

Bus::Bus(const BusSettings& settings) {
  buffer_warning_ = buffer_shortfall(settings.receive_buffer_bytes);
  for (const auto& url : settings.urls()) add_transport(url);
}

std::unique_ptr<Bus> Bus::in_memory() {
  std::unique_ptr<Bus> bus(new Bus());
  bus->add_transport("memq://");
  return bus;
}

Bus::~Bus() {
  for (auto& transport : transports_) transport->ending = true;
  for (auto& transport : transports_)
    if (transport->receiver.joinable()) transport->receiver.join();
}

void Bus::add_transport(const std::string& url) {
  const bool memory = url.starts_with("memq");
  transports_.push_back(std::make_unique<Transport>(url, memory));
  // Asking for the descriptor now makes LCM bind its sockets and test itself at this known moment.
  if (transports_.back()->lcm.good() && transports_.back()->lcm.getFileno() >= 0) return;
  if (const rlim_t left = free_descriptors(kDescriptors); left < kDescriptors)
    throw BusError(
        fmt::format("LCM cannot use {}: this process may open {} more files, and it takes some {}: "
                    "raise the limit (ulimit -n, LimitNOFILE=)",
                    url, left, kDescriptors));
  throw BusError("LCM cannot use " + url +
                 ": is there a route for multicast (ip route add 224.0.0.0/4 dev INTERFACE), "
                 "and is the group right?");
}

Bus::Transport& Bus::transport_of(const std::string& channel) {
  return channel.ends_with("_IMAGE") ? *transports_.back() : *transports_.front();
}

void Bus::subscribe_bytes(const std::string& channel, Queue queue,
                          std::function<void(const Bytes&, const std::string&)> handler) {
  subscribe_pattern(escaped(channel), queue, std::move(handler));
}

void Bus::subscribe_pattern(const std::string& pattern, Queue queue,
                            std::function<void(const Bytes&, const std::string&)> handler) {
  subscriptions_.push_back(
      std::make_unique<Subscription>(Subscription{this, pattern, queue, std::move(handler)}));
  const auto receive = [](const lcm::ReceiveBuffer* buffer, const std::string& channel,
                          Subscription* subscription) {
    subscription->bus->take_in(*subscription, *buffer, channel);
  };
  for (auto& transport : transports_) {
    auto* handle = transport->lcm.subscribeFunction<Subscription*>(pattern, receive,
                                                                   subscriptions_.back().get());
    if (handle == nullptr) throw BusError("LCM refuses to subscribe to " + pattern);
    // The receive thread empties LCM's own queue at once; it must outlast one burst only. One more
    // than the limit, because 1.3.1 counts so.
    handle->setQueueCapacity(static_cast<int>(std::max<std::size_t>(queue.messages, 30)));
  }
}

void Bus::take_in(Subscription& subscription, const lcm::ReceiveBuffer& buffer,
                  const std::string& channel) {
  const auto* begin = static_cast<const std::uint8_t*>(buffer.data);
  const std::lock_guard lock(mutex_);
  if (subscription.limits.newest_only) {
    std::erase_if(waiting_, [&](const Waiting& waiting) {
      const bool old = waiting.subscription == &subscription && waiting.channel == channel;
      if (old) --subscription.messages, subscription.bytes -= waiting.bytes.size();
      return old;
    });
  } else if (subscription.messages >= subscription.limits.messages ||
             subscription.bytes + buffer.data_size > subscription.limits.bytes) {
    ++overflowed_;
    last_error_ =
        fmt::format("{}: {} messages wait already, one was dropped: this host is too slow", channel,
                    subscription.messages);
    return;
  }
  ++subscription.messages;
  subscription.bytes += buffer.data_size;
  waiting_.push_back({&subscription, channel, Bytes(begin, begin + buffer.data_size)});
  arrived_.notify_one();
}

bool Bus::dispatch_one() {
  Waiting next;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return false;
    next = std::move(waiting_.front());
    waiting_.pop_front();
    --next.subscription->messages;
    next.subscription->bytes -= next.bytes.size();
  }
  next.subscription->handler(next.bytes, next.channel);
  return true;
}

bool Bus::handle(std::chrono::milliseconds longest_wait) {
  bool handled = false;
  if (transports_.front()->in_memory) {
    lcm::LCM& lcm = transports_.front()->lcm;
    const auto drain = [&](int wait) {
      while (lcm.handleTimeout(wait) > 0) wait = 0;
    };
    drain(static_cast<int>(longest_wait.count()));
    while (dispatch_one()) handled = true, drain(0);
    return handled;
  }
  for (auto& transport : transports_)
    if (!transport->receiver.joinable())
      transport->receiver = std::thread([&transport = *transport] {
        while (!transport.ending) transport.lcm.handleTimeout(50);
      });
  std::size_t round;
  {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, longest_wait, [this] { return !waiting_.empty() || woken_; });
    woken_ = false;
    round =
        waiting_.size();  // what comes meanwhile waits for the next round, so that ticks come too
  }
  for (; round > 0 && dispatch_one(); --round) handled = true;
  return handled;
}

void Bus::wake() {
  const std::lock_guard lock(mutex_);
  woken_ = true;
  arrived_.notify_one();
}

void Bus::publish_bytes(const std::string& channel, const Bytes& bytes) {
  if (transport_of(channel).lcm.publish(channel, bytes.data(),
                                        static_cast<unsigned int>(bytes.size())) == 0) {
    ++sent_;
    return;
  }
  const std::lock_guard lock(mutex_);
  last_error_ = channel + ": the network took no message: is there still a route for multicast?";
}

SenderWatch& Bus::watch_senders(const std::string& channel) {
  return senders_.emplace_back(channel, SenderWatch()).second;
}

std::string Bus::dispute(const std::string& channel) const {
  for (const auto& [name, senders] : senders_)
    if (name == channel && !senders.dispute().empty()) return senders.dispute();
  return "";
}

std::string Bus::dispute() const {
  for (const auto& [name, senders] : senders_)
    if (!senders.dispute().empty()) return name + ": " + senders.dispute();
  return "";
}

void Bus::note_undecodable(const std::string& channel, const Bytes& bytes, const std::string& why) {
  ++undecodable_;
  const std::lock_guard lock(mutex_);
  last_error_ = channel + ": a message was dropped: " + why;
  // Whoever sends one sends thousands: one line says it all.
  if (!former_type(bytes).empty() && former_channels_.insert(channel).second)
    warnings_.push_back(channel + ": all such messages are dropped: " + why);
}

std::optional<std::string> Bus::next_warning() {
  const std::lock_guard lock(mutex_);
  if (warnings_.empty()) return std::nullopt;
  std::string warning = std::move(warnings_.front());
  warnings_.pop_front();
  return warning;
}

std::string Bus::last_error() const {
  const std::lock_guard lock(mutex_);
  return last_error_;
}

}  // namespace arcstart
