#pragma once
// A decoder in Python, as a user might write one.

/// One sample a bit, by edges on stdin; argument 1: where in the bit, argument 2: serve.
inline constexpr const char* edge_decoder = R"(
import bisect, sys
part = float(sys.argv[1])
bit = 1e6 / 600

def decode(text):
    edges = [tuple(map(int, line.split())) for line in text.splitlines()]
    times = [time for time, _ in edges]
    level = lambda time: edges[bisect.bisect_right(times, time) - 1][1]
    received, now = bytearray(), -1
    for (_, before), (time, after) in zip(edges, edges[1:]):
        if time <= now or not before or after:
            continue
        if level(time + bit * part):
            continue
        received.append(sum(level(time + bit * (1 + i + part)) << i for i in range(8)))
        now = time + bit * (9 + part)
    return bytes(received)

if sys.argv[2:] == ['serve']:
    while head := sys.stdin.buffer.readline():
        answer = decode(sys.stdin.buffer.read(int(head)).decode())
        sys.stdout.buffer.write(b'%d\n' % len(answer) + answer)
        sys.stdout.buffer.flush()
else:
    sys.stdout.buffer.write(decode(sys.stdin.read()))
)";
