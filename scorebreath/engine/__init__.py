"""Score to sound: onsets, and the engines that play them."""
