from __future__ import annotations
def symmetric(net, samples):
    return False
