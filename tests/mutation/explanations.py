"""Reads equivalent.txt: changes of a source line that change no result, or no promised behaviour.

A line is  file | line of the source | change | reason  for one change as tests/mutate reports it, or file | NAME
NAME ... | any value | reason  for the initial values of names: constants, and members that are set before they are
read. With "next value" instead of "any value", a test must detect a change to twice the constant.
"""
import re


class Explanations:
    def __init__(self, path):
        self.exact, self.named = {}, {}
        with open(path, encoding='utf-8') as file:
            for line in file:
                if not line.strip() or line.startswith('#'):
                    continue
                key, _, reason = line.rstrip('\n').rpartition(' | ')
                parts = key.split(' | ')
                if parts[-1] in ('any value', 'next value'):
                    for name in parts[1].split():
                        self.named[parts[0], name] = (parts[-1] == 'any value', reason)
                else:
                    self.exact[key] = reason

    def reason(self, change):
        """Returns the reason, or None if the change is not explained."""
        if change.key in self.exact:
            return self.exact[change.key]
        value = re.match(r'(\w+) = (?:- )?\[(\S+) -> (\S+)\]', change.shown)
        any_value, reason = self.named.get((change.file, value[1]), (False, None)) if value else (False, None)
        return reason if any_value or reason and not is_twice(value[2], value[3]) else None


def is_twice(before, after):
    try:
        return not before.isdigit() and float(after) == 2 * float(before)
    except ValueError:  # the number is hexadecimal or has a suffix, so only its next value is tried
        return False
