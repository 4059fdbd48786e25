"""eSpeak NG, through the library that the package espeakng-loader carries: every language it has, in a worker."""
