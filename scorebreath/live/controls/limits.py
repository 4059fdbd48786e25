"""Bounds on what strangers can make a server do: how often it answers, and to how many."""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass, field

Sender = tuple[str, int]
"""Host and port."""


@dataclass(slots=True, kw_only=True)
class Bucket:
    """Leave for `rate` things a second, `burst` at once."""

    rate: float
    burst: float
    left: float = field(default=-1.0)
    since: float = field(default=0.0)

    def take(self, now: float, cost: float = 1.0) -> bool:
        """Whether there is leave for `cost` more; if so, it is used up."""
        grown = self.burst if self.left < 0.0 else self.left + max(0.0, now - self.since) * self.rate
        self.left, self.since = min(self.burst, grown), now
        if self.left < cost:
            return False
        self.left -= cost
        return True


class Leave:
    """Leave to answer: for every sender, and for all of them together."""

    MOST_SENDERS = 256

    def __init__(self, rate: float, burst: float, together: float) -> None:
        """Give `rate` a second and `burst` at once to each sender, and `together` times that to all."""
        self._rate, self._burst = rate, burst
        self._all = Bucket(rate=rate * together, burst=burst * together)
        self._each: OrderedDict[Sender, Bucket] = OrderedDict()

    def take(self, sender: Sender, now: float, cost: float = 1.0) -> bool:
        """Whether there is leave; if so, it is used up."""
        bucket = self._each.pop(sender, None) or Bucket(rate=self._rate, burst=self._burst)
        self._each[sender] = bucket
        while len(self._each) > self.MOST_SENDERS:
            self._each.popitem(last=False)
        return bucket.take(now, cost) and self._all.take(now, cost)


class Listeners:
    """Who is told of changes: a bounded number, each until it forgets to say so again."""

    MOST = 32
    STAYS = 60.0
    """s after the last `listen`"""

    def __init__(self) -> None:
        """Begin with nobody."""
        self._until: dict[Sender, float] = {}

    def add(self, listener: Sender, now: float) -> bool:
        """Add or renew one; False: there is no room."""
        if listener not in self._until and len(self.there(now)) >= self.MOST:
            return False
        self._until[listener] = now + self.STAYS
        return True

    def remove(self, listener: Sender) -> None:
        """Forget one, known or not."""
        self._until.pop(listener, None)

    def count(self, now: float) -> int:
        """How many listen now; may be asked by any thread."""
        return sum(until > now for until in tuple(self._until.values()))

    def there(self, now: float) -> tuple[Sender, ...]:
        """Those who listen now; those whose time is over are forgotten."""
        self._until = {listener: until for listener, until in self._until.items() if until > now}
        return tuple(self._until)
