"""Reads equivalent.txt: which changes are known to change nothing, or nothing that is promised.

A line is  file | line of the source | change | reason  of one change as tests/mutate reports it, or
file | NAME NAME ... | any value | reason  of the first values of names: constants, and members that are set before
they are read. With "next value" in place of "any value" twice a constant is a change that a test has to notice.
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
        """None: not explained."""
        if change.key in self.exact:
            return self.exact[change.key]
        value = re.match(r'(\w+) = (?:- )?\[(\S+) -> (\S+)\]', change.shown)
        any_value, reason = self.named.get((change.file, value[1]), (False, None)) if value else (False, None)
        return reason if any_value or reason and not is_twice(value[2], value[3]) else None


def is_twice(before, after):
    try:
        return not before.isdigit() and float(after) == 2 * float(before)
    except ValueError:  # hexadecimal, or with a suffix: there is a next one only
        return False
