"""Numbers as a record has them: number_of(machine, x) is the dual number x where all numbers of the record are dual, else its value;
without_slopes(x) is the value of a dual number, and any other number itself.

where(truth, x, y) is x where the truth holds, else y: no branch, so that each lane of packs has its own. some(truth): whether it holds, of
packs in a lane that has not left. share_of_lanes(truth): 1, of packs 0 in the lanes where it does not hold.
"""

from nivel.native.function import written

number_of, without_slopes = written("numbers:number_of"), written("numbers:without_slopes")
where, some, share_of_lanes = written("numbers:where"), written("numbers:some"), written("numbers:share_of_lanes")
